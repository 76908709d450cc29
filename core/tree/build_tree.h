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

// What may be mended, as a set.
enum class Repair : unsigned {
    kNone = 0,
    kZeroRadii = 1,      // a radius of 0 becomes the mean of its neighbours' positive radii
    kRepeatedPoints = 2, // connected points at one place become one; connections named twice count once
    kLonelyPoints = 4,   // points connected to nothing are left out
    kAll = 7
};
[[nodiscard]] constexpr Repair operator|(Repair a, Repair b) {
    return static_cast<Repair>(static_cast<unsigned>(a) | static_cast<unsigned>(b));
}
[[nodiscard]] constexpr bool allows(Repair set, Repair one) {
    return (static_cast<unsigned>(set) & static_cast<unsigned>(one)) != 0;
}

// The names that people use for single repairs.
inline constexpr std::pair<Repair, const char*> kRepairNames[] = {{Repair::kZeroRadii, "zero-radii"},
                                                                  {Repair::kRepeatedPoints, "repeated-points"},
                                                                  {Repair::kLonelyPoints, "lonely-points"}};

using Edge = std::pair<std::uint32_t, std::uint32_t>; // points

struct Graph {
    std::vector<Point> points;
    std::vector<int> labels; // per point, or empty
    std::vector<Edge> edges;
    std::vector<std::uint32_t> roots; // requested roots; a component without one gets its thickest end
};

// Largest coordinate and radius that make sense in mm; beyond, a file has the wrong unit or is damaged.
inline constexpr double kMaximumCoordinate = 1e7;
inline constexpr double kMaximumRadius = 1e6;

// `source(point)` says where a point came from, for messages ("liver.swc:41"). Fails on points that are not finite or
// too far out, radii that are negative, too large, or zero everywhere, edges to points that do not exist, and graphs
// without a segment; and on the first thing that needs a repair which `repair` does not allow.
[[nodiscard]] Result<VesselTree> build_tree(Graph graph, Repair repair,
                                            const std::function<std::string(std::uint32_t)>& source);

// Cuts points and edges that are known to be good into branches with their hierarchy. Roots of the result are those of
// `roots` that belong to a component with a segment.
[[nodiscard]] VesselTree assemble(std::vector<Point> points, std::vector<int> labels, const std::vector<Edge>& edges,
                                  const std::vector<std::uint32_t>& roots);

} // namespace ramus::tree
