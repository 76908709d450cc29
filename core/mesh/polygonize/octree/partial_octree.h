// PartialOctree: an octree of which only some subtrees get bricks, for a process that makes a part of a surface. Which
// subtrees there are, and how large each is, is known of the whole octree. The order of subtrees is that of
// build_octree(), and so is everything inside those that are built.
#pragma once

#include "core/mesh/polygonize/octree/splitter.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace ramus::mesh::bricks {

class PartialOctree {
public:
    // Divides space down to the subtrees, of which there are none if cancelled. Keeps references to the field and the
    // sizing.
    PartialOctree(const field::Field& field, const Sizing& sizing, Job& job,
                  const LargeAllocator<std::byte>& memory = {});
    PartialOctree(const PartialOctree&) = delete;
    PartialOctree& operator=(const PartialOctree&) = delete;

    [[nodiscard]] std::size_t subtrees() const { return seeds_.size(); }
    // The sizes of subtree `first` and of every `step`th after it.
    [[nodiscard]] std::vector<SubtreeSize> sizes(std::size_t first, std::size_t step, const Job& job) const;
    // Enters all subtrees in the octree, without bricks. `sizes`: of all of them.
    void enter(std::span<const SubtreeSize> sizes);
    // Builds the subtrees whose entry in `wanted` is not 0, and forgets the others.
    void build(std::span<const std::uint8_t> wanted, Job& job);

    [[nodiscard]] Octree& octree() { return octree_; }

private:
    Octree octree_;
    Splitter splitter_;
    std::vector<Seed> seeds_; // by subtree
};

} // namespace ramus::mesh::bricks
