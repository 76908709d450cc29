#include "core/mesh/polygonize/octree/subtree_schedule.h"

#include "core/mesh/polygonize/octree/neighbours.h"

#include <algorithm>

namespace ramus::mesh::bricks {

std::vector<SubtreeBatch> schedule_subtrees(const Octree& octree, std::size_t batch_bricks) {
    return schedule_subtrees(octree, touching_subtrees(octree), batch_bricks);
}

std::vector<SubtreeBatch> schedule_subtrees(const Octree& octree,
                                            std::span<const std::pair<std::uint32_t, std::uint32_t>> touching,
                                            std::size_t batch_bricks) {
    const std::vector<std::uint32_t> order = octree.subtrees_in_order();
    std::vector<SubtreeBatch> batches;
    std::vector<std::uint32_t> filled_in(octree.subtrees.size());
    std::size_t bricks = batch_bricks;
    for (const std::uint32_t subtree : order) {
        if (bricks >= batch_bricks) batches.emplace_back(), bricks = 0;
        filled_in[subtree] = static_cast<std::uint32_t>(batches.size() - 1);
        batches.back().fill.push_back(subtree);
        bricks += octree.subtrees[subtree].brick_count;
    }
    const auto latest_around = [&](const std::vector<std::uint32_t>& when) {
        std::vector<std::uint32_t> latest(when);
        for (const auto& [a, b] : touching) {
            latest[a] = std::max(latest[a], when[b]);
            latest[b] = std::max(latest[b], when[a]);
        }
        return latest;
    };
    const std::vector<std::uint32_t> joined_in = latest_around(filled_in);
    const std::vector<std::uint32_t> dropped_in = latest_around(joined_in);
    for (const std::uint32_t subtree : order) {
        batches[joined_in[subtree]].join.push_back(subtree);
        batches[dropped_in[subtree]].drop.push_back(subtree);
    }
    return batches;
}

} // namespace ramus::mesh::bricks
