#include "core/mesh/polygonize/stream/polygonize_to.h"

#include "core/base/paged_array.h"
#include "core/mesh/polygonize/feasible.h"
#include "core/mesh/polygonize/join/join_triangles.h"
#include "core/mesh/polygonize/stopwatch.h"
#include "core/mesh/polygonize/stream/tile_schedule.h"

#include <algorithm>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_group.h>
#include <string>

namespace ramus::mesh {

namespace bricks {

namespace {

// As many bricks are at work at a time as keep all cores busy and their cells in a few megabytes.
constexpr std::size_t kBatchBricks = std::size_t{1} << 13;

class VertexPages {
public:
    void append(const SurfaceVertices& from, std::size_t begin, std::size_t at, std::size_t count) {
        std::copy_n(from.positions.data() + begin, count, positions_.data() + at);
        std::copy_n(from.normals.data() + begin, count, normals_.data() + at);
        std::copy_n(from.radii.data() + begin, count, radii_.data() + at);
        std::copy_n(from.branches.data() + begin, count, branches_.data() + at);
    }
    void resize(std::size_t count) {
        positions_.resize(count);
        normals_.resize(count);
        radii_.resize(count);
        branches_.resize(count);
    }
    void empty(std::size_t first, std::size_t end) {
        const auto empty_in = [&](auto& array) {
            empty_pages(array.data() + first, (end - first) * sizeof(*array.data()));
        };
        empty_in(positions_), empty_in(normals_), empty_in(radii_), empty_in(branches_);
    }
    [[nodiscard]] VertexSpan values() const {
        return {positions_.values(), normals_.values(), radii_.values(), branches_.values()};
    }

private:
    PagedArray<glm::vec3> positions_, normals_;
    PagedArray<float> radii_;
    PagedArray<std::int32_t> branches_;
};

VertexSpan span_of(const SurfaceVertices& vertices) {
    return {std::span(vertices.positions).first(vertices.count), std::span(vertices.normals).first(vertices.count),
            std::span(vertices.radii).first(vertices.count), std::span(vertices.branches).first(vertices.count)};
}

class SurfaceStream {
public:
    SurfaceStream(const field::ConvolutionField& field, Octree& octree, SurfaceSink& sink)
        : field_(field), octree_(octree), sink_(sink), first_vertex_(octree.tiles.size() + 1, 0),
          dropped_(octree.tiles.size(), false) {}
    ~SurfaceStream() { handing_over_.wait(); }

    enum class End { kDone, kCancelled, kTooManyVertices, kSinkIsFull };

    // What one batch makes is handed over while the next one is worked on.
    End work(const std::vector<TileBatch>& batches, Job& job) {
        std::size_t bricks = 0;
        for (const TileBatch& batch : batches) {
            if (const End end = work(batch, JobStretch(job, progress_, progress_)); end != End::kDone) return end;
            for (const std::uint32_t tile : batch.fill) bricks += octree_.tiles[tile].brick_count;
            progress_ = 0.1F + 0.9F * static_cast<float>(bricks) / static_cast<float>(octree_.bricks.size());
        }
        handing_over_.wait();
        return full_ ? End::kSinkIsFull : End::kDone;
    }
    void add_to(PolygonizeStatistics& statistics) const {
        statistics.evaluations += evaluations_;
        statistics.samples += samples_;
    }

private:
    End work(const TileBatch& batch, const JobStretch& job) {
        find_neighbours(octree_, batch.fill, cells_.neighbours);
        fill_tiles(field_, octree_, batch.fill, cells_, job);
        handing_over_.wait(); // it reads from where vertices are now placed
        if (full_) return End::kSinkIsFull;
        if (job.cancelled()) return End::kCancelled;
        const std::size_t first = first_vertex_[batch.fill.front()];
        if (!place_vertices(batch.fill)) return End::kTooManyVertices;
        joined_ = join_tiles(field_, octree_, batch.join, cells_, vertices_.values(), job);
        if (job.cancelled()) return End::kCancelled;
        triangles_.resize(joined_.size());
        tbb::parallel_for(std::size_t{0}, joined_.size(), [&](std::size_t t) {
            triangles_[t].resize(joined_[t].triangle_count());
            joined_[t].write_triangles(vertices_.values(), triangles_[t]);
        });
        handing_over_.run([this, &batch, first] { full_ = !hand_over(batch, first); });
        return End::kDone;
    }

    bool hand_over(const TileBatch& batch, std::size_t first_vertex) {
        const VertexSpan vertices = vertices_.values();
        if (!sink_.add_vertices(vertices.subspan(first_vertex, vertices.size() - first_vertex))) return false;
        for (std::size_t t = 0; t < joined_.size(); ++t)
            if (!sink_.add_triangles({batch.join[t], triangles_[t], span_of(joined_[t].added), vertices})) return false;
        drop(batch.drop);
        return true;
    }

    // False: there would be more than an index counts.
    bool place_vertices(std::span<const std::uint32_t> tiles) {
        std::size_t end = first_vertex_[tiles.front()];
        for (const std::uint32_t tile : tiles) {
            first_vertex_[tile] = end;
            end += cells_.tiles[tile].vertex_count;
        }
        first_vertex_[tiles.back() + 1] = end;
        if (end >= kAddedBit) return false;
        vertices_.resize(end);
        tbb::parallel_for(std::size_t{0}, tiles.size(), [&](std::size_t t) {
            TileCells& cells = cells_.tiles[tiles[t]];
            const std::size_t first = first_vertex_[tiles[t]];
            vertices_.append(*cells.vertices, cells.first_vertex, first, cells.vertex_count);
            cells.vertices = nullptr;
            const Tile& tile = octree_.tiles[tiles[t]];
            for (std::uint32_t b = tile.first_brick; b < tile.first_brick + tile.brick_count; ++b)
                if (cells_.cells[b].crossed) cells_.cells[b].first_vertex += static_cast<std::uint32_t>(first);
        });
        cells_.vertices.clear();
        return true;
    }

    // Gives back what belongs to these tiles, and with it the pages that they share with tiles dropped before.
    void drop(std::span<const std::uint32_t> tiles) {
        for (const std::uint32_t tile : tiles) {
            dropped_[tile] = true;
            evaluations_ += cells_.tiles[tile].evaluations;
            samples_ += cells_.tiles[tile].samples;
            cells_.tiles[tile] = {};
        }
        constexpr std::uint32_t kPageOfBricks = 4096; // more than any page holds of anything
        for (std::size_t t = 0; t < tiles.size();) {
            std::uint32_t first = tiles[t];
            std::uint32_t end = first + 1;
            for (++t; t < tiles.size() && tiles[t] == end; ++t) ++end;
            const std::uint32_t first_brick = octree_.tiles[first].first_brick;
            const std::uint32_t end_brick = brick_end(end - 1);
            while (first > 0 && dropped_[first - 1] && first_brick - octree_.tiles[first].first_brick < kPageOfBricks)
                --first;
            while (end < dropped_.size() && dropped_[end] && brick_end(end - 1) - end_brick < kPageOfBricks) ++end;
            empty(first, end);
        }
    }
    [[nodiscard]] std::uint32_t brick_end(std::uint32_t tile) const {
        return octree_.tiles[tile].first_brick + octree_.tiles[tile].brick_count;
    }
    void empty(std::uint32_t first_tile, std::uint32_t end_tile) {
        const std::uint32_t first = octree_.tiles[first_tile].first_brick;
        const std::uint32_t count = brick_end(end_tile - 1) - first;
        if (count == 0) return;
        const Brick& last = octree_.bricks[first + count - 1];
        const std::uint32_t list = octree_.bricks[first].list_begin;
        empty_pages(&octree_.lists[list], (last.list_begin + last.list_count - list) * sizeof(std::uint32_t));
        empty_pages(&cells_.neighbours[first], count * sizeof(Neighbourhood));
        empty_pages(&cells_.cells[first], count * sizeof(BrickCells));
        vertices_.empty(first_vertex_[first_tile], first_vertex_[end_tile]);
    }

    const field::ConvolutionField& field_;
    Octree& octree_;
    SurfaceSink& sink_;
    SurfaceCells cells_;
    VertexPages vertices_;
    std::vector<std::size_t> first_vertex_; // by tile, as far as filled
    std::vector<bool> dropped_;             // by tile
    std::vector<JoinedTile> joined_;        // of the last batch
    std::vector<std::vector<glm::uvec3>> triangles_;
    std::uint64_t evaluations_ = 0, samples_ = 0;
    float progress_ = 0.1F;
    bool full_ = false;
    tbb::task_group handing_over_;
};

} // namespace

} // namespace bricks

Result<void> polygonize_to(SurfaceSink& sink, const field::ConvolutionField& field, const PolygonizeOptions& options,
                           Job& job, PolygonizeStatistics* statistics) {
    using bricks::SurfaceStream;
    const field::CullingSegments culling(field);
    const bricks::Sizing sizing = bricks::make_sizing(field, culling.origin, options.detail, options.cell_mm);
    if (auto possible = check_feasible(field, sizing, options, Road::kStream); !possible) return possible;
    Stopwatch watch;
    PolygonizeStatistics counted;
    bricks::Octree octree = bricks::build_octree(field, culling, sizing, job);
    counted.bricks = octree.bricks.size();
    counted.bricks_s = watch.lap();
    auto end = job.cancelled() ? SurfaceStream::End::kCancelled : SurfaceStream::End::kDone;
    if (end == SurfaceStream::End::kDone) {
        const std::vector<bricks::TileBatch> batches = bricks::schedule_tiles(octree, bricks::kBatchBricks);
        SurfaceStream stream(field, octree, sink);
        end = stream.work(batches, job);
        stream.add_to(counted);
    }
    counted.cells_s = watch.lap();
    if (statistics != nullptr) *statistics = counted;
    switch (end) {
    case SurfaceStream::End::kDone:
        break;
    case SurfaceStream::End::kCancelled:
        return fail("cancelled");
    case SurfaceStream::End::kSinkIsFull:
        return fail("the surface cannot be taken further");
    case SurfaceStream::End::kTooManyVertices:
        return fail("the surface has more than 2 147 483 647 vertices", {},
                    options.cell_mm > 0.0 ? "raise --cell" : "lower --detail, or prune with --prune");
    }
    job.report(1.0F);
    return {};
}

} // namespace ramus::mesh
