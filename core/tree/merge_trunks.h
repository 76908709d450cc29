// Merges polylines, each with its own points, into one network: joins coincident points, and keeps a trunk that several
// polylines trace only once. Lengths are in the unit of the graph.
#pragma once

#include "core/tree/build_tree.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace ramus::tree {

struct Joined {
    std::vector<std::uint32_t> first; // by remaining point: the lowest old index among the points merged into it
    std::size_t points = 0;           // number of removed points
    std::size_t edges = 0;            // number of removed duplicate edges
    std::optional<glm::dvec3> repeat; // the middle of one of these edges
};

// Joins points with identical coordinates: all of them, or (`ends_only`) only if one of them is an end of a chain. Also
// joins two ends of chains within a millionth of the graph's extent. The larger radius stays, since a joint lies inside
// the wider vessel. Points of different systems are never joined.
Joined join_coincident(Graph& graph, bool ends_only);

// A stretch of a polyline that was removed, since another polyline traces the same vessel.
struct RepeatedTrunk {
    glm::dvec3 from{0.0}, to{0.0}; // in the graph's unit
    std::size_t points = 0;
};

inline constexpr double kSameTrunk = 0.35; // radii; tuned: trunks in centerlines of VMTK differ by less

// Removes repeated trunks. Centerlines that all begin at the root repeat the trunk once for every outlet. A chain of
// directed edges that begins where another chain begins, or within kSameTrunk radii from there, repeats that chain as
// long as it stays within this distance. The repeated part is removed, and the rest is connected to the other chain
// where it leaves. Overlaps of less than a diameter stay, since two vessels diverge there. Unused points stay in the
// graph, without edges.
[[nodiscard]] std::vector<RepeatedTrunk> merge_repeated_trunks(Graph& graph);

} // namespace ramus::tree
