// SubtreeSchedule: the order of work on the subtrees of an octree, such that few are in memory at a time. Subtrees are
// filled in batches, in their order. A subtree is joined as soon as all subtrees that touch it are filled, and dropped
// when all that touch it are joined. The mesh has the same order: batch by batch, the vertices of its subtrees, the
// vertices that joining added, and the triangles.
#pragma once

#include "core/mesh/polygonize/octree/octree.h"

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace ramus::mesh::bricks {

// The subtrees to fill, then to join, then to drop; each list in the octree's order.
struct SubtreeBatch {
    std::vector<std::uint32_t> fill, join, drop;
};

// A batch that keeps all cores busy and fits into the caches.
inline constexpr std::size_t kBatchBricks = std::size_t{1} << 13;

// Batches of `batch_bricks` bricks or a few more. The result for an updated octree equals that for a newly built one.
[[nodiscard]] std::vector<SubtreeBatch> schedule_subtrees(const Octree& octree,
                                                          std::size_t batch_bricks = kBatchBricks);
// The same, with the result of touching_subtrees() (octree/neighbours.h) where it is known.
[[nodiscard]] std::vector<SubtreeBatch>
schedule_subtrees(const Octree& octree, std::span<const std::pair<std::uint32_t, std::uint32_t>> touching,
                  std::size_t batch_bricks = kBatchBricks);

} // namespace ramus::mesh::bricks
