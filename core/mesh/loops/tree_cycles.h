// Finds a short cycle of a tree's graph for each independent loop.
#pragma once

#include "core/tree/vessel_tree.h"

#include <vector>

namespace ramus::mesh {

// Returns closed centerlines, each point once and in order: one for each independent cycle, except for cycles for which
// the search visits too many nodes (4,096). A minimum spanning tree leaves one branch for each cycle. The cycle of such
// a branch is the shortest way from one of its ends to the other along the spanning tree and the shorter such branches.
[[nodiscard]] std::vector<std::vector<tree::Point>> short_cycles(const tree::VesselTree& tree);

} // namespace ramus::mesh
