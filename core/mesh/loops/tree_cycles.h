// The cycles of a tree's graph: a short one for each loop.
#pragma once

#include "core/tree/vessel_tree.h"

#include <vector>

namespace ramus::mesh {

// Closed centerlines, each point once and in order, as many as the graph has independent cycles but for those of
// thousands of branches. Each takes the shortest way back from one end of a branch to the other, along branches that
// are shorter or that no cycle needs; the shortest branches come first.
[[nodiscard]] std::vector<std::vector<tree::Point>> short_cycles(const tree::VesselTree& tree);

} // namespace ramus::mesh
