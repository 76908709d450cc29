// TileSchedule: in which order to work on the tiles of an octree so that few are in memory at a time. Tiles are filled
// in batches, in their own order; each is joined as soon as all that touch it are filled, and let go when nothing that
// is still to be joined touches it.
#pragma once

#include "core/mesh/polygonize/octree/octree.h"

#include <cstdint>
#include <vector>

namespace ramus::mesh::bricks {

struct TileBatch {
    std::vector<std::uint32_t> fill, join, drop; // tiles, ascending; done one after the other
};

// About `batch_bricks` bricks in each batch. The octree freshly built.
[[nodiscard]] std::vector<TileBatch> schedule_tiles(const Octree& octree, std::size_t batch_bricks);

} // namespace ramus::mesh::bricks
