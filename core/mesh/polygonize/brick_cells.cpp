#include "core/mesh/polygonize/brick_cells.h"

#include "core/mesh/polygonize/brick_sampler.h"

#include <bit>
#include <oneapi/tbb/parallel_for.h>

namespace ramus::mesh::bricks {

namespace {

Neighbourhood find_neighbours(const BrickSet& set, std::uint32_t index) {
    const Brick& brick = set.bricks[index];
    const int side = brick_units(brick.level);
    Neighbourhood around;
    around.brick.fill(kNone);
    around.brick[kSelf] = index;
    around.kind[kSelf] = Neighbour::kSame;
    for (int dz = -1; dz <= 1; ++dz) {
        for (int dy = -1; dy <= 1; ++dy) {
            for (int dx = -1; dx <= 1; ++dx) {
                const auto direction = static_cast<std::size_t>(direction_index(dx, dy, dz));
                if (direction == kSelf) continue;
                const glm::ivec3 corner = brick.corner + glm::ivec3(dx, dy, dz) * side;
                if (const std::uint32_t same = set.find(corner, brick.level); same != kNone) {
                    around.brick[direction] = same;
                    around.kind[direction] = Neighbour::kSame;
                    continue;
                }
                const glm::ivec3 parent = corner & glm::ivec3(~(2 * side - 1));
                if (const std::uint32_t coarser = set.find(parent, brick.level + 1); coarser != kNone) {
                    around.brick[direction] = coarser;
                    around.kind[direction] = Neighbour::kCoarser;
                    continue;
                }
                if (brick.level == 0) continue;
                // Any of the children there that touch this brick.
                const int half = side / 2;
                bool finer = false;
                for (int child = 0; child < 8 && !finer; ++child) {
                    const glm::ivec3 c(child & 1, child >> 1 & 1, child >> 2);
                    if ((dx == 1 && c.x == 1) || (dx == -1 && c.x == 0) || (dy == 1 && c.y == 1) || (dy == -1 && c.y == 0) ||
                        (dz == 1 && c.z == 1) || (dz == -1 && c.z == 0))
                        continue;
                    finer = set.find(corner + c * half, brick.level - 1) != kNone;
                }
                if (finer) around.kind[direction] = Neighbour::kFiner;
            }
        }
    }
    return around;
}

} // namespace

const CellRecord& SurfaceCells::record(std::uint32_t brick, int cell) const {
    const BrickCells& b = cells[brick];
    const int before = std::popcount(b.recorded & ((std::uint64_t{1} << cell) - 1));
    return chunks[brick / kChunkBricks].records[b.first_record + static_cast<std::uint32_t>(before)];
}

std::uint32_t SurfaceCells::vertex(std::uint32_t brick, int cell, int edge_midpoint) const {
    const auto c = static_cast<std::size_t>(cell);
    return cells[brick].first_vertex + cells[brick].first[c] +
           record(brick, cell).loop_of[static_cast<std::size_t>(edge_midpoint)];
}

std::uint32_t SurfaceCells::vertex_of_whole_edge(std::uint32_t brick, int cell, int edge) const {
    const auto e = static_cast<std::size_t>(edge);
    if (is_recorded(brick, cell)) return vertex(brick, cell, kEdges[e].midpoint);
    const BrickCells& b = cells[brick];
    const auto c = static_cast<std::size_t>(cell);
    return b.first_vertex + b.first[c] + kCornerCases[b.mask[c]].loop_of_edge[e];
}

void append_projected(const field::ConvolutionField& field, std::span<const std::uint32_t> list,
                      field::Projection& projection, BrickChunk& chunk) {
    chunk.evaluations += field::project(field, list, projection);
    for (std::size_t n = 0; n < projection.size(); ++n) {
        chunk.positions.emplace_back(projection.origin + glm::dvec3(projection.x[n], projection.y[n], projection.z[n]));
        chunk.normals.emplace_back(projection.nx[n], projection.ny[n], projection.nz[n]);
        chunk.radii.push_back(projection.radius[n]);
        chunk.branches.push_back(field.segments().branch[static_cast<std::size_t>(projection.segment[n])]);
    }
}

SurfaceCells fill_bricks(const field::ConvolutionField& field, const BrickSet& set, Job& job) {
    SurfaceCells surface;
    const std::size_t count = set.bricks.size();
    surface.neighbours.resize(count);
    surface.cells.resize(count);
    surface.chunks.resize((count + kChunkBricks - 1) / kChunkBricks);
    std::atomic<std::size_t> done{0};
    tbb::parallel_for(std::size_t{0}, surface.chunks.size(), [&](std::size_t c) {
        if (job.cancelled()) return;
        thread_local BrickSampler sampler;
        for (std::size_t index = c * kChunkBricks; index < std::min(count, (c + 1) * kChunkBricks); ++index) {
            surface.neighbours[index] = find_neighbours(set, static_cast<std::uint32_t>(index));
            sampler.fill(field, set, set.bricks[index], surface.neighbours[index], surface.cells[index], surface.chunks[c]);
        }
        job.report(0.15F + 0.65F * static_cast<float>(++done) / static_cast<float>(surface.chunks.size()));
    });
    return surface;
}

} // namespace ramus::mesh::bricks
