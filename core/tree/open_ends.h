// Open ends: files whose vessels are not connected, though one ends within another (tracings of one vessel after the
// other). An end that lies within the radius of a vessel of another piece is joined to it where it is nearest.
#pragma once

#include "core/tree/build_tree.h"

#include <cstdint>
#include <vector>

namespace ramus::tree {

// Joins what may be joined in a graph known to be good, with a root for each piece: the deepest end first, pieces of
// one system only, and never twice, so that no loop comes about. The place on the other vessel becomes a point where
// none is near. Of the roots of pieces that are one now the thickest stays that is no joined end. Returns the ends that
// were joined, ascending, by the numbers that they had before; one that was at a place of the other vessel is gone.
[[nodiscard]] std::vector<std::uint32_t> join_open_ends(Graph& graph);

} // namespace ramus::tree
