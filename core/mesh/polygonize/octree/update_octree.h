// Updates an octree after some segments of the tree have changed. Divides only the cubes that these segments reach. The
// result equals the octree that build_octree() would return, except for the order of its arrays.
#pragma once

#include "core/mesh/polygonize/octree/neighbours.h"
#include "core/mesh/polygonize/octree/splitter.h"

namespace ramus::mesh::bricks {

// One state of a tree, and its segments and sizing pieces that the other state does not have.
struct TreeState {
    const field::Field& field;
    const Sizing& sizing;
    std::vector<std::uint32_t> changed_segments, changed_pieces;
};

// Both states must have the same extent. Incomplete if cancelled.
[[nodiscard]] OctreeChanges update_octree(Octree& octree, const TreeState& before, const TreeState& after, Job& job);

} // namespace ramus::mesh::bricks
