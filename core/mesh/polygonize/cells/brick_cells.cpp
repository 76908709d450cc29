#include "core/mesh/polygonize/cells/brick_cells.h"

#include "core/mesh/polygonize/cells/brick_sampler.h"
#include "core/mesh/polygonize/cells/hanging_corners.h"

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

bool reaches_beyond(const Octree& octree, const SurfaceCells& surface, std::uint32_t tile,
                    const OctreeChanges& changes) {
    // Grid points on each side of a brick.
    static constexpr std::array<GridBits, 6> kSides = [] {
        constexpr GridBits kAll = grid_points_below(5, 5, 5);
        return std::array<GridBits, 6>{grid_points_below(1, 5, 5), kAll & ~grid_points_below(4, 5, 5),
                                       grid_points_below(5, 1, 5), kAll & ~grid_points_below(5, 4, 5),
                                       grid_points_below(5, 5, 1), kAll & ~grid_points_below(5, 5, 4)};
    }();
    const Tile& t = octree.tiles[tile];
    for (std::uint32_t b = t.first_brick; b < t.first_brick + t.brick_count; ++b) {
        if (!surface.cells[b].crossed) continue;
        const Neighbourhood& around = surface.neighbours[b];
        const Brick& brick = octree.bricks[b];
        const GridBits inside = surface.cells[b].grid_bits();
        const auto crosses_cells = [&](int direction) {
            for (std::uint64_t cells = cells_toward(direction); cells != 0; cells &= cells - 1)
                if (surface.cells[b].first[static_cast<std::size_t>(std::countr_zero(cells))] != kNoVertex) return true;
            return false;
        };
        for (int d = 0; d < kDirections; ++d) {
            const Neighbour kind = around.kind(d);
            if (kind == Neighbour::kAbsent) continue; // the surface does not touch it
            const glm::ivec3 step(d % 3 - 1, d / 3 % 3 - 1, d / 9 - 1);
            if (kind == Neighbour::kFiner) {
                // Whose these are is not noted: any beyond the tile may have changed.
                const glm::ivec3 low = brick.corner + step * brick_units(brick.level) - t.corner;
                const int size = brick_units(t.level);
                const bool within =
                    low.x >= 0 && low.y >= 0 && low.z >= 0 && low.x < size && low.y < size && low.z < size;
                if (!within && crosses_cells(d)) return true;
                continue;
            }
            if (changes.tiles[octree.bricks[around.brick[static_cast<std::size_t>(d)]].tile] == 0) continue;
            if (kind == Neighbour::kCoarser && crosses_cells(d)) return true;
            if (kind == Neighbour::kCoarser) continue;
            for (int axis = 0; axis < 3; ++axis) {
                if (step[axis] == 0) continue;
                const GridBits side = kSides[static_cast<std::size_t>(2 * axis + (step[axis] > 0 ? 1 : 0))];
                if ((inside & side) != 0 && (inside & side) != side) return true;
            }
        }
    }
    return false;
}

void fill_tiles(const field::ConvolutionField& field, const Octree& octree, std::span<const std::uint32_t> tiles,
                SurfaceCells& surface, Job& job) {
    surface.cells.resize(octree.bricks.size());
    surface.tiles.resize(octree.tiles.size());
    std::atomic<std::size_t> done{0};
    tbb::parallel_for(std::size_t{0}, tiles.size(), [&](std::size_t t) {
        if (job.cancelled()) return;
        thread_local BrickSampler sampler;
        thread_local TileCells scratch;
        scratch.vertex_count = scratch.evaluations = scratch.samples = 0;
        scratch.records.clear(), scratch.arc_vertices.clear();
        const Tile& tile = octree.tiles[tiles[t]];
        sampler.begin(field, octree, tile, surface.neighbours);
        // Backwards, so that a brick finds its upper neighbours' samples there.
        for (std::uint32_t n = tile.brick_count; n-- > 0;)
            sampler.fill(tile.first_brick + n, surface.cells[tile.first_brick + n], scratch);
        surface.tiles[tiles[t]] = trimmed(scratch);
        job.report(0.15F + 0.65F * static_cast<float>(++done) / static_cast<float>(tiles.size()));
    });
}

} // namespace ramus::mesh::bricks
