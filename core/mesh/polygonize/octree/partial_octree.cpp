#include "core/mesh/polygonize/octree/partial_octree.h"

#include <algorithm>
#include <oneapi/tbb/parallel_for.h>
#include <utility>

namespace ramus::mesh::bricks {

namespace {

// So many groups for each part that equal numbers of groups are about equal work.
std::size_t segments_of_group(const field::Field& field, std::size_t parts) {
    constexpr std::size_t kGroupsOfPart = 16, kLeast = 1024;
    return std::clamp(field.skeleton().present().size() / (kGroupsOfPart * parts), kLeast, kGroupSegments);
}

} // namespace

PartialOctree::PartialOctree(const field::Field& field, const Sizing& sizing, std::size_t parts, Job& job,
                             const LargeAllocator<std::byte>& memory)
    : octree_(begin_octree(field, sizing, memory)), splitter_{field, sizing, octree_.lattice},
      groups_(splitter_, octree_, segments_of_group(field, parts), job) {}

FoundSubtrees PartialOctree::find(std::size_t first, std::size_t step, const Job& job) const {
    FoundSubtrees found;
    for (std::size_t n = first; n < groups(); n += step) {
        const SubtreeGroup group = groups_.group(n, job);
        std::vector<FoundSubtrees::One> subtrees(group.seeds.size());
        tbb::parallel_for(std::size_t{0}, subtrees.size(), [&](std::size_t t) {
            const Seed& seed = group.seeds[t];
            if (!job.cancelled())
                subtrees[t] = {seed.cube.corner, seed.cube.level, seed.parent, seed.child,
                               size_of_subtree(splitter_, seed)};
        });
        if (job.cancelled()) break;
        found.groups.push_back(
            {static_cast<std::uint32_t>(group.upper.size()), static_cast<std::uint32_t>(subtrees.size())});
        found.upper.insert(found.upper.end(), group.upper.begin(), group.upper.end());
        found.subtrees.insert(found.subtrees.end(), subtrees.begin(), subtrees.end());
    }
    return found;
}

std::vector<SubtreeSize> PartialOctree::enter(std::span<const FoundSubtrees> found) {
    struct Next {
        std::size_t upper = 0, subtree = 0;
    };
    std::vector<Next> next(found.size());
    std::vector<SubtreeSize> sizes;
    for (std::size_t n = 0; n < groups(); ++n) {
        const FoundSubtrees& by = found[n % found.size()];
        const FoundSubtrees::Group& group = by.groups[n / found.size()];
        Next& at = next[n % found.size()];
        const auto indices = enter_upper(octree_, std::span(by.upper).subspan(at.upper, group.upper));
        first_.push_back(octree_.subtrees.size());
        for (const FoundSubtrees::One& one : std::span(by.subtrees).subspan(at.subtree, group.subtrees)) {
            const std::uint32_t parent = indices.empty() ? one.parent : indices[one.parent];
            octree_.upper[parent].children[one.child] = UpperNode::subtree(octree_.subtrees.size());
            octree_.subtrees.push_back({parent, one.child, 0, one.size.bricks, one.corner, one.level});
            sizes.push_back(one.size);
        }
        at = {at.upper + group.upper, at.subtree + group.subtrees};
    }
    first_.push_back(octree_.subtrees.size());
    return sizes;
}

void PartialOctree::build(std::span<const std::uint8_t> wanted, Job& job) {
    for (std::size_t n = 0; n < groups() && !job.cancelled(); ++n) {
        const auto of_group = wanted.subspan(first_[n], first_[n + 1] - first_[n]);
        if (std::ranges::all_of(of_group, [](std::uint8_t w) { return w == 0; })) continue;
        SubtreeGroup group = groups_.group(n, job);
        if (job.cancelled()) return;
        std::vector<Seed> chosen;
        for (std::size_t t = 0; t < of_group.size(); ++t) {
            if (of_group[t] == 0) continue;
            Seed& seed = chosen.emplace_back(std::move(group.seeds[t]));
            seed.entered = static_cast<std::uint32_t>(first_[n] + t);
            seed.parent = octree_.subtrees[seed.entered].parent;
        }
        append_subtrees(splitter_, chosen, octree_, job);
    }
}

} // namespace ramus::mesh::bricks
