// Division: how the subtrees of an octree are divided among the parts of a surface, and what a part needs of the
// others.
#pragma once

#include "core/base/grouped.h"
#include "core/base/large_array.h"
#include "core/mesh/polygonize/octree/octree.h"
#include "core/mesh/polygonize/octree/partial_octree.h"
#include "core/mesh/polygonize/surface_batches.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace ramus::mesh::bricks {

// By subtree: those that touch it, some more than once.
using Touching = Grouped<std::uint32_t>;
// `pairs`: all of them (touching_subtrees() in octree/neighbours.h).
[[nodiscard]] Touching touching_each(std::span<const std::pair<std::uint32_t, std::uint32_t>> pairs,
                                     std::size_t subtrees, const LargeAllocator<std::byte>& memory = {});

// Adds all subtrees that touch those in the set, whose entry is not 0.
void add_ring(std::vector<std::uint8_t>& set, const Touching& touching);

// Of the estimated work of all subtrees, the share of those in the range; of all bricks, the share of those in the set.
[[nodiscard]] double share_of_work(std::span<const SubtreeSize> sizes, SubtreeRange range);
[[nodiscard]] double share_of_bricks(std::span<const SubtreeSize> sizes, std::span<const std::uint8_t> set);

// Consecutive subtrees for each of `count` parts, some of which may have none, such that the part with the most work
// has about as little as possible. The work of a part is that of its subtrees and of those around that it computes,
// too. `sizes`: by subtree.
[[nodiscard]] std::vector<SubtreeRange> divided(const Octree& octree, std::span<const SubtreeSize> sizes,
                                                const Touching& touching, std::size_t count);

// By subtree: 1 for the own ones and those with cells that joining them asks for. Both must have bricks, and so must
// all that touch them.
[[nodiscard]] std::vector<std::uint8_t> subtrees_to_fill(const Octree& octree, SubtreeRange own,
                                                         const Touching& touching);

} // namespace ramus::mesh::bricks
