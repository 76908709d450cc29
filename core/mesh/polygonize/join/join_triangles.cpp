#include "core/mesh/polygonize/join/join_triangles.h"

#include "core/mesh/polygonize/join/brick_joiner.h"

#include <atomic>
#include <oneapi/tbb/parallel_for.h>

namespace ramus::mesh::bricks {

void join_tiles(const field::ConvolutionField& field, const Octree& octree, std::span<const std::uint32_t> tiles,
                const SurfaceCells& surface, const VertexSpan& vertices, std::vector<JoinedTile>& joined,
                const JobStretch& job) {
    joined.resize(tiles.size());
    std::atomic<std::size_t> done{0};
    const EdgePolygons general(field, octree, surface, vertices);
    tbb::parallel_for(std::size_t{0}, tiles.size(), [&](std::size_t t) {
        if (job.cancelled()) return;
        const Tile& tile = octree.tiles[tiles[t]];
        joined[t].clear();
        // Euler: about as many quads as vertices.
        joined[t].quads.reserve(surface.tiles[tiles[t]].vertex_count * 9 / 8 + 64);
        join_bricks(surface, general, tile.first_brick, tile.first_brick + tile.brick_count, joined[t]);
        job.report(static_cast<float>(++done) / static_cast<float>(joined.size()));
    });
}

} // namespace ramus::mesh::bricks
