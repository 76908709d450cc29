// From points and edges to a VesselTree: repairs what can be repaired, cuts the graph into branches, and finds the
// hierarchy from the roots. Any graph is legal: loops, several components, nodes of any degree, chains of any length.
#pragma once

#include "core/base/error.h"
#include "core/tree/vessel_tree.h"

#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

namespace ramus::tree {

enum class Repair { kAll, kNone };

struct Graph {
    std::vector<Point> points;
    std::vector<int> labels; // per point, or empty
    std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
    std::vector<std::uint32_t> roots; // wanted roots; a component without one gets its thickest end
};

// Largest coordinate and radius that make sense in mm; beyond, a file has the wrong unit or is damaged.
inline constexpr double kMaximumCoordinate = 1e7;
inline constexpr double kMaximumRadius = 1e6;

// `place(point)` says where a point came from, for messages ("liver.swc:41"). Fails on points that are not finite or
// too far out, radii that are negative, too large, or zero everywhere, edges to points that do not exist, and graphs
// without a segment; with Repair::kNone also on all that would be repaired (zero radii, repeated points, points by
// themselves).
[[nodiscard]] Result<VesselTree> build_tree(Graph graph, Repair repair,
                                            const std::function<std::string(std::uint32_t)>& place);

// Cuts points and edges that are known to be good into branches with their hierarchy. Roots of the result are those of
// `roots` that belong to a component with a segment.
[[nodiscard]] VesselTree assemble(std::vector<Point> points, std::vector<int> labels,
                                  const std::vector<std::pair<std::uint32_t, std::uint32_t>>& edges,
                                  const std::vector<std::uint32_t>& roots);

} // namespace ramus::tree
