// Pruning of short leaf branches: the spurs that thinning leaves behind (after Hahn et al. 2001, the paper's [6]).
#pragma once

#include "core/tree/prepared_tree.h"

namespace ramus::tree {

// A leaf branch goes when its length < ratio x the length of its parent branch; a node left with two branches becomes
// an inner point of one branch; repeated until nothing goes. Root branches stay. ratio <= 0 keeps all. Points that
// belong to no branch any more are removed.
[[nodiscard]] PreparedTree prune(const VesselTree& tree, double ratio);

} // namespace ramus::tree
