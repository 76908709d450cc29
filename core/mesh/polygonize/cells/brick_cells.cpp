#include "core/mesh/polygonize/cells/brick_cells.h"

#include "core/mesh/polygonize/cells/brick_sampler.h"
#include "core/mesh/polygonize/cells/hanging_corners.h"
#include "core/mesh/polygonize/cells/specks.h"

#include <atomic>
#include <bit>
#include <mutex>
#include <oneapi/tbb/enumerable_thread_specific.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/partitioner.h>
#include <utility>

namespace ramus::mesh::bricks {

const CellRecord& SurfaceCells::record(const Brick& brick, std::uint32_t index, int cell) const {
    return record_of(cells[index], subtrees[brick.subtree], cell);
}

std::uint32_t SurfaceCells::vertex(const Brick& brick, std::uint32_t index, int cell, int crossing) const {
    const std::uint16_t in_brick = cells[index].first[static_cast<std::size_t>(cell)];
    if (in_brick == kNoVertex) return kAbsent;
    const std::uint32_t first = cells[index].first_vertex + in_brick;
    if (!is_recorded(index, cell)) return first;
    const std::uint8_t circuit = circuit_of(record(brick, index, cell), subtrees[brick.subtree], crossing);
    return circuit == kNoCircuit ? kAbsent : first + circuit;
}

void SurfaceCells::reuse_vertices() {
    for (auto& block : vertices) {
        block->count = 0;
        spare.push_back(std::move(block));
    }
    vertices.clear();
}

void SurfaceVertices::reserve(std::size_t more) {
    const std::size_t needed = count + more + field::kProjectionPadding;
    if (needed > positions.size()) resize_vertices(2 * needed);
}

std::uint64_t append_projected(field::BrickField& field, field::Projection& guesses, SurfaceVertices& vertices,
                               std::span<const field::OwnedGuess> owned) {
    vertices.reserve(guesses.size());
    const std::size_t first = vertices.count;
    vertices.count += guesses.size();
    const field::SurfacePoints to{vertices.positions.data() + first, vertices.normals.data() + first,
                                  vertices.radii.data() + first, vertices.branches.data() + first,
                                  vertices.dominance.data() + first};
    std::uint64_t kernels = field.project(guesses, to);
    if (auto* separation = field.separation(); separation != nullptr && !owned.empty())
        kernels += separation->project_apart(guesses, owned, to);
    field.flatten(to, guesses.size());
    return kernels;
}

field::GridAxes grid_axes(const Lattice& lattice, const Brick& brick) {
    field::GridAxes axes;
    for (int n = 0; n < field::kGridSide; ++n) {
        const glm::dvec3 p = lattice.position(brick.corner + glm::ivec3(n * cell_units(brick.level)));
        const auto i = static_cast<std::size_t>(n);
        axes.x[i] = p.x, axes.y[i] = p.y, axes.z[i] = p.z;
    }
    return axes;
}

field::LatticeAxes lattice_axes(const Lattice& lattice, const Brick& brick) {
    field::LatticeAxes axes;
    for (int n = 0; n < field::kLatticeSide; ++n) {
        const glm::dvec3 p = lattice.position(brick.corner + glm::ivec3(n << brick.level));
        const auto i = static_cast<std::size_t>(n);
        axes.x[i] = p.x, axes.y[i] = p.y, axes.z[i] = p.z;
    }
    return axes;
}

namespace {

// Prefetches the cache lines of a value.
template <class T> void fetch_ahead(const T& value) {
    constexpr std::size_t kLine = 64;
    const auto* const begin = reinterpret_cast<const std::byte*>(&value);
    for (std::size_t at = 0; at < sizeof(T); at += kLine) __builtin_prefetch(begin + at);
}

// Blocks of vertices of one thread. Vertices stay in blocks until their indices in the mesh are known.
class VertexBlocks {
public:
    explicit VertexBlocks(SurfaceCells& surface) : surface_(surface) {}

    // The current block, with capacity for most subtrees; it grows for others.
    SurfaceVertices& block() {
        SurfaceVertices*& block = current_.local();
        if (block == nullptr || block->positions.size() - block->count < kReserve) {
            const std::lock_guard lock(mutex_);
            surface_.vertices.push_back(take_block());
            block = surface_.vertices.back().get();
        }
        return *block;
    }

private:
    static constexpr std::size_t kBlock = std::size_t{1} << 16;
    static constexpr std::size_t kReserve = kBlock / 8;

    std::unique_ptr<SurfaceVertices> take_block() {
        if (!surface_.spare.empty()) {
            auto block = std::move(surface_.spare.back());
            surface_.spare.pop_back();
            return block;
        }
        auto block = std::make_unique<SurfaceVertices>();
        block->resize_vertices(kBlock);
        return block;
    }

    SurfaceCells& surface_;
    tbb::enumerable_thread_specific<SurfaceVertices*> current_{nullptr};
    std::mutex mutex_;
};

} // namespace

bool reaches_beyond(const Octree& octree, const SurfaceCells& surface, std::uint32_t subtree,
                    const OctreeChanges& changes) {
    // Grid points on each side of a brick.
    static constexpr std::array<GridBits, 6> kSides = [] {
        constexpr GridBits kAll = grid_points_below(5, 5, 5);
        return std::array<GridBits, 6>{kLowerSides[0],         kAll & ~kEdgeStarts[0], kLowerSides[1],
                                       kAll & ~kEdgeStarts[1], kLowerSides[2],         kAll & ~kEdgeStarts[2]};
    }();
    const Subtree& t = octree.subtrees[subtree];
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
                // The subtree beyond is not known here, so any change beyond counts.
                const glm::ivec3 low = brick.corner + step * brick_units(brick.level) - t.corner;
                const int size = brick_units(t.level);
                const bool within =
                    low.x >= 0 && low.y >= 0 && low.z >= 0 && low.x < size && low.y < size && low.z < size;
                if (!within && crosses_cells(d)) return true;
                continue;
            }
            if (changes.subtrees[octree.bricks[around.brick[static_cast<std::size_t>(d)]].subtree] == 0) continue;
            if (surface.cells[b].walls != kNoWalls) return true; // they may go on there
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

void fill_subtrees(const field::Field& field, const Octree& octree, std::span<const std::uint32_t> subtrees,
                   SurfaceCells& surface, const JobRange& job) {
    surface.cells.resize(octree.bricks.size());
    for (const std::uint32_t subtree : subtrees) {
        const Subtree& t = octree.subtrees[subtree];
        surface.cells.provide(t.first_brick, t.first_brick + t.brick_count);
    }
    surface.subtrees.resize(octree.subtrees.size());
    VertexBlocks blocks(surface);
    tbb::enumerable_thread_specific<BrickSampler> samplers([&] { return BrickSampler(field); });
    tbb::enumerable_thread_specific<Specks> specks([&] { return Specks(field); });
    std::atomic<std::size_t> done{0};
    const auto fill = [&](std::size_t t) {
        if (job.cancelled()) return;
        BrickSampler& sampler = samplers.local();
        const Subtree& subtree = octree.subtrees[subtrees[t]];
        SubtreeCells made;
        SurfaceVertices& vertices = blocks.block();
        made.vertices = &vertices;
        made.first_vertex = vertices.count;
        sampler.begin(octree, subtree.first_brick, subtree.brick_count, vertices);
        std::vector<std::uint32_t> parted;
        // Backward, so that the samples of a brick's upper neighbours are already known.
        for (std::uint32_t n = subtree.brick_count; n-- > 0;) {
            const std::uint32_t index = subtree.first_brick + n;
            if (n > 0) {
                fetch_ahead(surface.neighbours[index - 1]);
                fetch_ahead(surface.cells[index - 1]);
                fetch_ahead(octree.lists[octree.bricks[index - 1].list_begin]);
            }
            sampler.fill(index, surface.neighbours[index], surface.cells[index], made);
            if (sampler.parts_vessels()) parted.push_back(index);
            if (sampler.has_walled_cells()) made.walled_bricks.push_back(index);
        }
        specks.local().leave_out(octree, subtrees[t], surface.neighbours, parted, surface.cells, made, vertices);
        made.vertex_count = vertices.count - made.first_vertex;
        surface.subtrees[subtrees[t]] = std::move(made);
        job.report(static_cast<float>(++done) / static_cast<float>(subtrees.size()));
    };
    // Grain size 1: subtrees with contacts take many times as long as others, and are often consecutive.
    tbb::parallel_for(std::size_t{0}, subtrees.size(), fill, tbb::simple_partitioner());
}

} // namespace ramus::mesh::bricks
