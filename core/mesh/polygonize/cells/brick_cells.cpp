#include "core/mesh/polygonize/cells/brick_cells.h"

#include "core/mesh/polygonize/cells/brick_sampler.h"

#include <atomic>
#include <bit>
#include <oneapi/tbb/parallel_for.h>
#include <utility>

namespace ramus::mesh::bricks {

const CellRecord& SurfaceCells::record(std::uint32_t brick, int cell) const {
    const BrickCells& b = cells[brick];
    const int before = std::popcount(b.recorded & ((std::uint64_t{1} << cell) - 1));
    return chunks[brick / kChunkBricks].records[b.first_record + static_cast<std::uint32_t>(before)];
}

std::uint32_t SurfaceCells::vertex(std::uint32_t brick, int cell, int edge_midpoint) const {
    const std::uint32_t first = cells[brick].first_vertex + cells[brick].first[static_cast<std::size_t>(cell)];
    if (!is_recorded(brick, cell)) return first;
    return first + record(brick, cell).loop_of[static_cast<std::size_t>(edge_midpoint)];
}

void append_projected(const field::ConvolutionField& field, std::span<const std::uint32_t> list,
                      field::Projection& projection, BrickChunk& chunk) {
    const std::uint64_t samples = field::project(field, list, projection);
    chunk.evaluations += samples * list.size();
    chunk.samples += samples;
    const std::size_t first = chunk.positions.size();
    const std::size_t count = projection.size();
    chunk.positions.resize(first + count);
    chunk.normals.resize(first + count);
    chunk.radii.insert(chunk.radii.end(), projection.radius.begin(),
                       projection.radius.begin() + static_cast<std::ptrdiff_t>(count));
    chunk.branches.resize(first + count);
    const field::FieldSegment* segments = field.segments().data();
    for (std::size_t n = 0; n < count; ++n) {
        chunk.positions[first + n] =
            glm::vec3(projection.origin + glm::dvec3(projection.x[n], projection.y[n], projection.z[n]));
        chunk.normals[first + n] = {projection.nx[n], projection.ny[n], projection.nz[n]};
        chunk.branches[first + n] = segments[projection.segment[n]].branch;
    }
}

SurfaceCells fill_bricks(const field::ConvolutionField& field, const Octree& octree,
                         UnsetArray<Neighbourhood> neighbours, Job& job) {
    SurfaceCells surface;
    const std::size_t count = octree.bricks.size();
    surface.neighbours = std::move(neighbours);
    surface.cells = UnsetArray<BrickCells>(count);
    surface.chunks.resize((count + kChunkBricks - 1) / kChunkBricks);
    std::atomic<std::size_t> done{0};
    tbb::parallel_for(std::size_t{0}, surface.chunks.size(), [&](std::size_t c) {
        if (job.cancelled()) return;
        thread_local BrickSampler sampler;
        for (std::size_t index = c * kChunkBricks; index < std::min(count, (c + 1) * kChunkBricks); ++index)
            sampler.fill(field, octree, octree.bricks[index], surface.neighbours[index], surface.cells[index],
                         surface.chunks[c]);
        job.report(0.15F + 0.65F * static_cast<float>(++done) / static_cast<float>(surface.chunks.size()));
    });
    return surface;
}

} // namespace ramus::mesh::bricks
