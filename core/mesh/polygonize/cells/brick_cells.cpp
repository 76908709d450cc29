#include "core/mesh/polygonize/cells/brick_cells.h"

#include "core/mesh/polygonize/cells/brick_sampler.h"

#include <atomic>
#include <bit>
#include <oneapi/tbb/parallel_for.h>
#include <utility>

namespace ramus::mesh::bricks {

const CellRecord& SurfaceCells::record(const Brick& brick, std::uint32_t index, int cell) const {
    const BrickCells& b = cells[index];
    const int before = std::popcount(b.recorded & ((std::uint64_t{1} << cell) - 1));
    return tiles[brick.tile].records[b.first_record + static_cast<std::uint32_t>(before)];
}

std::uint32_t SurfaceCells::vertex(const Brick& brick, std::uint32_t index, int cell, int edge_midpoint) const {
    const std::uint32_t first = cells[index].first_vertex + cells[index].first[static_cast<std::size_t>(cell)];
    if (!is_recorded(index, cell)) return first;
    return first + record(brick, index, cell).loop_of[static_cast<std::size_t>(edge_midpoint)];
}

void TileCells::reserve_vertices(std::size_t count) {
    const std::size_t room = count + field::kProjectionPadding;
    if (room <= positions.size()) return;
    const std::size_t grown = 2 * room;
    positions.resize(grown);
    normals.resize(grown);
    radii.resize(grown);
    branches.resize(grown);
}

void append_projected(const field::LocalSegments& local, field::Projection& projection, TileCells& tile) {
    const std::size_t first = tile.vertex_count;
    tile.reserve_vertices(first + projection.size());
    tile.evaluations += field::project(local, projection,
                                       {tile.positions.data() + first, tile.normals.data() + first,
                                        tile.radii.data() + first, tile.branches.data() + first});
    tile.samples += projection.size();
    tile.vertex_count = first + projection.size();
}

namespace {

// What `scratch` holds, in memory of its own size.
TileCells trimmed(const TileCells& scratch) {
    TileCells tile;
    const auto count = static_cast<std::ptrdiff_t>(scratch.vertex_count);
    tile.positions.assign(scratch.positions.begin(), scratch.positions.begin() + count);
    tile.normals.assign(scratch.normals.begin(), scratch.normals.begin() + count);
    tile.radii.assign(scratch.radii.begin(), scratch.radii.begin() + count);
    tile.branches.assign(scratch.branches.begin(), scratch.branches.begin() + count);
    tile.vertex_count = scratch.vertex_count;
    tile.records = scratch.records;
    tile.arc_vertices = scratch.arc_vertices;
    tile.evaluations = scratch.evaluations;
    tile.samples = scratch.samples;
    return tile;
}

} // namespace

SurfaceCells fill_bricks(const field::ConvolutionField& field, const Octree& octree,
                         LargeArray<Neighbourhood> neighbours, Job& job) {
    SurfaceCells surface;
    surface.neighbours = std::move(neighbours);
    surface.cells.resize(octree.bricks.size());
    surface.tiles.resize(octree.tiles.size());
    std::atomic<std::size_t> done{0};
    tbb::parallel_for(std::size_t{0}, octree.tiles.size(), [&](std::size_t t) {
        if (job.cancelled()) return;
        thread_local BrickSampler sampler;
        thread_local TileCells scratch;
        scratch.vertex_count = scratch.evaluations = scratch.samples = 0;
        scratch.records.clear(), scratch.arc_vertices.clear();
        sampler.begin(field, octree, octree.tiles[t], surface.neighbours);
        // Backwards, so that a brick finds its upper neighbours' samples there.
        const std::uint32_t first = octree.tiles[t].first_brick;
        for (std::uint32_t n = octree.tiles[t].brick_count; n-- > 0;)
            sampler.fill(first + n, surface.cells[first + n], scratch);
        surface.tiles[t] = trimmed(scratch);
        job.report(0.15F + 0.65F * static_cast<float>(++done) / static_cast<float>(surface.tiles.size()));
    });
    return surface;
}

} // namespace ramus::mesh::bricks
