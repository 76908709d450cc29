#include "core/mesh/polygonize/brick_cells.h"

#include "core/base/huge_pages.h"
#include "core/mesh/polygonize/brick_sampler.h"

#include <bit>
#include <oneapi/tbb/parallel_for.h>

namespace ramus::mesh::bricks {

namespace {

Neighbourhood find_neighbours(const BrickSet& set, std::uint32_t index) {
    const Brick& brick = set.bricks[index];
    const int bit = 4 + brick.level; // a brick's edge is 1 << bit units
    const int side = brick_units(brick.level);
    const glm::ivec3 own(brick.corner.x >> bit & 1, brick.corner.y >> bit & 1, brick.corner.z >> bit & 1);
    const glm::ivec3 parent = brick.corner & glm::ivec3(~(2 * side - 1));
    // All 27 places lie in the parent and the seven cubes of its size on our side of it.
    std::array<const BrickSet::Cube*, 8> cubes;
    for (int n = 0; n < 8; ++n) {
        const glm::ivec3 step(n & 1, n >> 1 & 1, n >> 2);
        cubes[static_cast<std::size_t>(n)] = set.find(parent + step * (own * 2 - 1) * (2 * side), brick.level + 1);
    }
    Neighbourhood around;
    around.brick.fill(kNone);
    for (int dz = -1; dz <= 1; ++dz) {
        for (int dy = -1; dy <= 1; ++dy) {
            for (int dx = -1; dx <= 1; ++dx) {
                const glm::ivec3 place = own + glm::ivec3(dx, dy, dz); // -1 .. 2 in halves of the parent
                const int n = (place.x >> 1 & 1) | (place.y >> 1 & 1) << 1 | (place.z >> 1 & 1) << 2;
                const BrickSet::Cube* cube = cubes[static_cast<std::size_t>(n)];
                if (cube == nullptr) continue;
                const auto direction = static_cast<std::size_t>(direction_index(dx, dy, dz));
                if (cube->brick != kNone) {
                    around.brick[direction] = cube->brick;
                    around.kind[direction] = Neighbour::kCoarser;
                    continue;
                }
                const auto child = static_cast<std::size_t>((place.x & 1) | (place.y & 1) << 1 | (place.z & 1) << 2);
                const std::uint32_t found = cube->children[child];
                if (found == kNone) continue;
                around.kind[direction] = found == BrickSet::kFiner ? Neighbour::kFiner : Neighbour::kSame;
                if (found != BrickSet::kFiner) around.brick[direction] = found;
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
    chunk.samples += field::kProjectionSteps * projection.size();
    const std::size_t first = chunk.positions.size();
    const std::size_t count = projection.size();
    chunk.positions.resize(first + count);
    chunk.normals.resize(first + count);
    chunk.radii.insert(chunk.radii.end(), projection.radius.begin(),
                       projection.radius.begin() + static_cast<std::ptrdiff_t>(count));
    chunk.branches.resize(first + count);
    for (std::size_t n = 0; n < count; ++n) {
        chunk.positions[first + n] =
            glm::vec3(projection.origin + glm::dvec3(projection.x[n], projection.y[n], projection.z[n]));
        chunk.normals[first + n] = {projection.nx[n], projection.ny[n], projection.nz[n]};
        chunk.branches[first + n] = field.segments().branch[static_cast<std::size_t>(projection.segment[n])];
    }
}

SurfaceCells fill_bricks(const field::ConvolutionField& field, const BrickSet& set, Job& job) {
    SurfaceCells surface;
    const std::size_t count = set.bricks.size();
    resize_large(surface.neighbours, count);
    resize_large(surface.cells, count);
    surface.chunks.resize((count + kChunkBricks - 1) / kChunkBricks);
    std::atomic<std::size_t> done{0};
    tbb::parallel_for(std::size_t{0}, surface.chunks.size(), [&](std::size_t c) {
        if (job.cancelled()) return;
        thread_local BrickSampler sampler;
        for (std::size_t index = c * kChunkBricks; index < std::min(count, (c + 1) * kChunkBricks); ++index) {
            surface.neighbours[index] = find_neighbours(set, static_cast<std::uint32_t>(index));
            sampler.fill(field, set, set.bricks[index], surface.neighbours[index], surface.cells[index],
                         surface.chunks[c]);
        }
        job.report(0.15F + 0.65F * static_cast<float>(++done) / static_cast<float>(surface.chunks.size()));
    });
    return surface;
}

} // namespace ramus::mesh::bricks
