#include "core/mesh/polygonize/octree/partial_octree.h"

#include <oneapi/tbb/parallel_for.h>
#include <utility>

namespace ramus::mesh::bricks {

PartialOctree::PartialOctree(const field::Field& field, const Sizing& sizing, Job& job,
                             const LargeAllocator<std::byte>& memory)
    : octree_(begin_octree(field, sizing, memory)), splitter_{field, sizing, octree_.lattice},
      seeds_(find_subtrees(splitter_, octree_, job)) {}

std::vector<SubtreeSize> PartialOctree::sizes(std::size_t first, std::size_t step, const Job& job) const {
    const std::size_t count = first < seeds_.size() ? (seeds_.size() - first + step - 1) / step : 0;
    std::vector<SubtreeSize> sizes(count);
    tbb::parallel_for(std::size_t{0}, count, [&](std::size_t n) {
        if (!job.cancelled()) sizes[n] = size_of_subtree(splitter_, seeds_[first + n * step]);
    });
    return sizes;
}

void PartialOctree::enter(std::span<const SubtreeSize> sizes) {
    octree_.subtrees.resize(seeds_.size());
    for (std::size_t n = 0; n < seeds_.size(); ++n) {
        Seed& seed = seeds_[n];
        seed.entered = static_cast<std::uint32_t>(n);
        octree_.subtrees[n] = {seed.parent, seed.child, 0, sizes[n].bricks, seed.cube.corner, seed.cube.level};
        octree_.upper[seed.parent].children[seed.child] = UpperNode::subtree(n);
    }
}

void PartialOctree::build(std::span<const std::uint8_t> wanted, Job& job) {
    std::vector<Seed> chosen;
    for (std::size_t n = 0; n < seeds_.size(); ++n)
        if (wanted[n] != 0) chosen.push_back(std::move(seeds_[n]));
    seeds_.clear();
    append_subtrees(splitter_, chosen, octree_, job);
}

} // namespace ramus::mesh::bricks
