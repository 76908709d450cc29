// Brings an octree up to date with a tree of which only some segments changed: only where those reach is it split anew,
// and the outcome is the octree that building from nothing would give.
#pragma once

#include "core/mesh/polygonize/octree/neighbours.h"
#include "core/mesh/polygonize/octree/splitter.h"

namespace ramus::mesh::bricks {

// One state of a tree, and what of it is not in the other.
struct TreeState {
    const field::Field& field;
    const Sizing& sizing;
    std::vector<std::uint32_t> changed_segments, changed_pieces;
};

// Both states in the same frame. Incomplete when cancelled.
[[nodiscard]] OctreeChanges update_octree(Octree& octree, const TreeState& before, const TreeState& after, Job& job);

} // namespace ramus::mesh::bricks
