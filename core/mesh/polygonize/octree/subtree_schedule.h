// SubtreeSchedule: in which order to work on the subtrees of an octree so that few are in memory at a time. Subtrees
// are filled in batches, in their own order; each is joined as soon as all that touch it are filled, and let go when
// nothing that is still to be joined touches it. The order is also that of the mesh: batch by batch its subtrees' own
// vertices, those that joining added, and the triangles.
#pragma once

#include "core/mesh/polygonize/octree/octree.h"

#include <cstdint>
#include <vector>

namespace ramus::mesh::bricks {

// Subtrees to fill, to join and to drop, one after the other; each in the octree's order.
struct SubtreeBatch {
    std::vector<std::uint32_t> fill, join, drop;
};

// So many bricks at a time keep all cores busy and their cells in the caches.
inline constexpr std::size_t kBatchBricks = std::size_t{1} << 13;

// Batches of `batch_bricks` bricks or a few more. The same for an octree that was updated as for one made from nothing.
[[nodiscard]] std::vector<SubtreeBatch> schedule_subtrees(const Octree& octree,
                                                          std::size_t batch_bricks = kBatchBricks);

} // namespace ramus::mesh::bricks
