#include "core/mesh/polygonize/octree/subtree_groups.h"

#include <iterator>
#include <oneapi/tbb/enumerable_thread_specific.h>
#include <oneapi/tbb/parallel_for.h>
#include <utility>

namespace ramus::mesh::bricks {

namespace {

// Divides a cube, level by level, down to those for which is_end(seed) holds. Ends early if cancelled.
template <class IsEnd> SubtreeGroup divide(const Splitter& splitter, Seed top, const IsEnd& is_end, const Job& job) {
    SubtreeGroup group;
    std::vector<Seed>& frontier = group.seeds;
    frontier.push_back(std::move(top));
    tbb::enumerable_thread_specific<Children> scratch; // large cubes take much
    for (bool some = true; some && !job.cancelled();) {
        std::vector<std::uint32_t> upper_of(frontier.size());
        some = false;
        for (std::size_t i = 0; i < frontier.size(); ++i) {
            if (is_end(frontier[i])) continue;
            some = true;
            upper_of[i] = static_cast<std::uint32_t>(group.upper.size());
            group.upper.push_back({frontier[i].parent, static_cast<std::uint8_t>(frontier[i].child), 0});
        }
        std::vector<std::vector<Seed>> next(frontier.size());
        tbb::parallel_for(std::size_t{0}, frontier.size(), [&](std::size_t i) {
            if (job.cancelled()) return;
            if (is_end(frontier[i])) {
                next[i].push_back(std::move(frontier[i]));
                return;
            }
            Children& children = scratch.local();
            splitter.split_upper(frontier[i].cube, children);
            for (std::size_t c = 0; c < field::kChildren; ++c) {
                std::uint8_t& full = group.upper[upper_of[i]].full;
                if (children.verdicts[c] == Children::Verdict::kInside)
                    full = static_cast<std::uint8_t>(full | 1U << c);
                if (children.verdicts[c] >= Children::Verdict::kBrick)
                    next[i].emplace_back(splitter, frontier[i].cube, children, c, upper_of[i]);
            }
        });
        frontier.clear();
        for (auto& part : next) std::ranges::move(part, std::back_inserter(frontier));
    }
    return group;
}

} // namespace

std::vector<std::uint32_t> enter_upper(Octree& octree, std::span<const FoundUpper> upper) {
    std::vector<std::uint32_t> indices;
    indices.reserve(upper.size());
    for (const FoundUpper& found : upper) {
        const std::uint32_t parent = indices.empty() ? found.parent : indices[found.parent];
        const std::uint32_t index = octree.add_upper_node();
        if (index > 0) octree.enter(parent, found.child, index);
        for (std::size_t c = 0; c < field::kChildren; ++c)
            if ((found.full >> c & 1) != 0) octree.nodes[octree.upper[index].node][c] = OctreeEntry::full();
        indices.push_back(index);
    }
    return indices;
}

void enter_upper(Octree& octree, SubtreeGroup& group) {
    if (group.upper.empty()) return;
    const std::vector<std::uint32_t> indices = enter_upper(octree, group.upper);
    for (Seed& seed : group.seeds) seed.parent = indices[seed.parent];
}

SubtreeGroups::SubtreeGroups(const Splitter& splitter, Octree& octree, std::size_t most_segments, const Job& job)
    : splitter_(splitter), lists_(splitter.field, splitter.sizing) {
    Seed top;
    top.cube = lists_.top_cube(octree.top_level);
    const auto is_small = [&](const Seed& seed) {
        return seed.is_subtree || seed.cube.segments.size() <= most_segments;
    };
    SubtreeGroup above = divide(splitter_, std::move(top), is_small, job);
    enter_upper(octree, above);
    if (!job.cancelled()) cubes_ = std::move(above.seeds);
}

SubtreeGroup SubtreeGroups::group(std::size_t n, const Job& job) const {
    return divide(
        splitter_, cubes_[n], [](const Seed& seed) { return seed.is_subtree; }, job);
}

} // namespace ramus::mesh::bricks
