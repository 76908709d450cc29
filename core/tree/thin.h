// Thinning: a tree with fewer points, for pictures that stand for a moment only.
#pragma once

#include "core/tree/vessel_tree.h"

namespace ramus::tree {

// Branches keep both ends, and of their inner points those that lie at least `spacing` local radii beyond the last one
// kept. Points that no branch uses any more stay in the list.
[[nodiscard]] VesselTree thinned(VesselTree tree, double spacing);

} // namespace ramus::tree
