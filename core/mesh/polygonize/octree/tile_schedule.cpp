#include "core/mesh/polygonize/octree/tile_schedule.h"

#include "core/mesh/polygonize/octree/neighbours.h"

#include <algorithm>

namespace ramus::mesh::bricks {

std::vector<TileBatch> schedule_tiles(const Octree& octree, std::size_t batch_bricks) {
    const std::vector<std::uint32_t> order = octree.tiles_in_order();
    std::vector<TileBatch> batches;
    std::vector<std::uint32_t> filled_in(octree.tiles.size());
    std::size_t bricks = batch_bricks;
    for (const std::uint32_t tile : order) {
        if (bricks >= batch_bricks) batches.emplace_back(), bricks = 0;
        filled_in[tile] = static_cast<std::uint32_t>(batches.size() - 1);
        batches.back().fill.push_back(tile);
        bricks += octree.tiles[tile].brick_count;
    }
    const auto pairs = touching_tiles(octree);
    const auto latest_around = [&](const std::vector<std::uint32_t>& when) {
        std::vector<std::uint32_t> latest(when);
        for (const auto& [a, b] : pairs) {
            latest[a] = std::max(latest[a], when[b]);
            latest[b] = std::max(latest[b], when[a]);
        }
        return latest;
    };
    const std::vector<std::uint32_t> joined_in = latest_around(filled_in);
    const std::vector<std::uint32_t> dropped_in = latest_around(joined_in);
    for (const std::uint32_t tile : order) {
        batches[joined_in[tile]].join.push_back(tile);
        batches[dropped_in[tile]].drop.push_back(tile);
    }
    return batches;
}

} // namespace ramus::mesh::bricks
