// One function for each kind of edit. Only apply() calls them, after it has checked ids, fractions and numbers.
#pragma once

#include "core/tree/edit_graph.h"

namespace ramus::tree {

// core/tree/edit_connections.cpp
[[nodiscard]] Result<EditedTree> join(const VesselTree& tree, const Edit& edit);
[[nodiscard]] Result<EditedTree> cut(const VesselTree& tree, const Edit& edit);
[[nodiscard]] Result<EditedTree> remove_branches(const VesselTree& tree, const Edit& edit);
// core/tree/edit_roots.cpp
[[nodiscard]] Result<EditedTree> move_root(const VesselTree& tree, const Edit& edit);
[[nodiscard]] Result<EditedTree> flip(const VesselTree& tree, const Edit& edit);
// core/tree/edit_radii.cpp
[[nodiscard]] Result<EditedTree> change_radii(const VesselTree& tree, const Edit& edit);

} // namespace ramus::tree
