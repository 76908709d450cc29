// Joins open ends: in some files, vessels were traced one by one and are not connected, although one ends within
// another. An end that lies within the radius of a vessel of another piece is joined to the nearest place of that
// vessel.
#pragma once

#include "core/tree/build_tree.h"

#include <cstdint>
#include <vector>

namespace ramus::tree {

// The graph must be valid, with a root for each piece. Joins the deepest end first. Joins only pieces of one system,
// and only pieces that are not connected yet, so that no loop is created. Adds a point on the other vessel if none is
// near. If pieces with roots are joined, the thickest root that is no joined end stays. Returns the joined ends,
// ascending, by their old numbers. An end that coincides with a place of the other vessel is merged with it.
[[nodiscard]] std::vector<std::uint32_t> join_open_ends(Graph& graph);

} // namespace ramus::tree
