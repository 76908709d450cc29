// Finds where vessels touch that should not: two centerlines nearer than the sum of their radii although the way
// between the two places along the tree is long, so that no joint excuses it.
#pragma once

#include "core/tree/grow/centerlines.h"

#include <utility>
#include <vector>

namespace ramus::tree::growth {

// Pairs of segments of the skeleton of which at least one is marked as changed, each once, in ascending order.
// joint_reach: how many times the sum of the radii the way along the tree may be at a joint.
[[nodiscard]] std::vector<std::pair<int, int>> touching(const Skeleton& tree, const Centerlines& lines,
                                                        const std::vector<bool>& changed, const Organ& organ,
                                                        double spacing_mm, double joint_reach);

} // namespace ramus::tree::growth
