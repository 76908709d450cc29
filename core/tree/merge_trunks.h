// Polylines that have points of their own become one network: what lies at one place is joined, and trunks that several
// of them trace alike are kept once.
#pragma once

#include "core/tree/build_tree.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace ramus::tree {

struct Joined {
    std::vector<std::uint32_t> first; // by point that is left: the old index of the first that it stands for
    std::size_t points = 0;           // that went
    std::size_t edges = 0;            // that were there twice, and went
    std::optional<glm::dvec3> repeat; // the middle of one of those
};

// Joins points at the very same place: all of them, or (`ends_only`) only where one is an end of a chain. Two ends are
// at one place within a millionth of the graph's extent, too. The larger of the radii stays, for a joint lies inside
// the wider vessel. Systems stay apart.
Joined join_coincident(Graph& graph, bool ends_only);

// A stretch of one polyline that was left out, since another traces the same vessel.
struct RepeatedTrunk {
    glm::dvec3 from{0.0}, to{0.0}; // in the graph's unit
    std::size_t points = 0;
};

inline constexpr double kSameTrunk = 0.35; // of the local radius; tuned: trunks of VMTK's centerlines differ by less

// Centerlines that all begin at the root repeat the trunk once for every outlet. Chains of edges (each from its first
// point to its second) that begin where another one begins, or within kSameTrunk of the radius from there, follow it as
// long as they stay so near and are connected to it where they leave; what they repeat goes. Overlaps of less than a
// diameter stay: there two vessels part. Points that nothing uses any more stay in the graph, without edges.
[[nodiscard]] std::vector<RepeatedTrunk> merge_repeated_trunks(Graph& graph);

} // namespace ramus::tree
