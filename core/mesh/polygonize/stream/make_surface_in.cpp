#include "core/mesh/polygonize/stream/make_surface_in.h"

#include "core/base/mapped_pages.h"
#include "core/base/stopwatch.h"
#include "core/mesh/polygonize/feasible.h"
#include "core/mesh/polygonize/join/join_triangles.h"
#include "core/mesh/polygonize/octree/subtree_schedule.h"

#include <oneapi/tbb/parallel_for.h>

namespace ramus::mesh {

namespace bricks {

namespace {

// Makes the surface of an octree's bricks in batches (octree/subtree_schedule.h), so that what is worked on is small
// enough for the caches, and what is done with can go.
class SurfaceStream {
public:
    // The octree freshly built. Its lists are emptied on the way.
    SurfaceStream(const field::Field& field, Octree& octree, SurfaceStore& store)
        : field_(field), octree_(octree), store_(store), placed_(octree.subtrees.size()),
          dropped_(octree.subtrees.size(), false) {}

    enum class End { kDone, kCancelled, kTooManyVertices, kStoreIsFull };
    [[nodiscard]] End work(Job& job);

    [[nodiscard]] const PolygonizeStatistics& statistics() const { return statistics_; }

private:
    [[nodiscard]] End work(const SubtreeBatch& batch, const JobRange& job);
    [[nodiscard]] End place_vertices(std::span<const std::uint32_t> subtrees);
    [[nodiscard]] End place_triangles(std::span<const std::uint32_t> subtrees);
    [[nodiscard]] End grow_vertices(std::size_t count);
    void tell_walls(std::span<const std::uint32_t> subtrees);
    void drop(std::span<const std::uint32_t> subtrees);
    void empty(std::uint32_t first_subtree, std::uint32_t end_subtree);
    [[nodiscard]] std::uint32_t brick_end(std::uint32_t subtree) const {
        return octree_.subtrees[subtree].first_brick + octree_.subtrees[subtree].brick_count;
    }

    field::Field field_;
    Octree& octree_;
    SurfaceStore& store_;
    SurfaceCells cells_;
    struct SubtreeVertices {
        std::size_t first = 0, end = 0;
    };
    std::vector<SubtreeVertices> placed_; // by subtree
    std::vector<bool> dropped_;           // by subtree
    std::vector<JoinedSubtree> joined_;   // of one batch
    std::size_t vertex_count_ = 0;
    PolygonizeStatistics statistics_;
};

SurfaceStream::End SurfaceStream::work(Job& job) {
    constexpr float kOctree = 0.1F; // of the progress
    float progress = kOctree;
    std::size_t bricks = 0;
    for (const SubtreeBatch& batch : schedule_subtrees(octree_)) {
        if (const End end = work(batch, JobRange(job, progress, progress)); end != End::kDone) return end;
        bricks += brick_end(batch.fill.back()) - octree_.subtrees[batch.fill.front()].first_brick;
        progress = kOctree + (1.0F - kOctree) * static_cast<float>(bricks) / static_cast<float>(octree_.bricks.size());
    }
    return End::kDone;
}

SurfaceStream::End SurfaceStream::work(const SubtreeBatch& batch, const JobRange& job) {
    Stopwatch watch;
    find_neighbours(octree_, batch.fill, cells_.neighbours);
    fill_subtrees(field_, octree_, batch.fill, cells_, job);
    if (job.cancelled()) return End::kCancelled;
    statistics_.cells_s += watch.lap();
    tell_walls(batch.fill);
    if (const End end = place_vertices(batch.fill); end != End::kDone) return end;
    join_subtrees(field_, octree_, batch.join, cells_, store_.vertices(), joined_, job);
    if (job.cancelled()) return End::kCancelled;
    if (const End end = place_triangles(batch.join); end != End::kDone) return end;
    drop(batch.drop);
    store_.end_batch();
    statistics_.join_s += watch.lap();
    return End::kDone;
}

void SurfaceStream::tell_walls(std::span<const std::uint32_t> subtrees) {
    for (const std::uint32_t subtree : subtrees)
        for (const std::uint32_t index : cells_.subtrees[subtree].walled_bricks)
            store_.add_walled(box_of_brick(octree_, index));
}

SurfaceStream::End SurfaceStream::grow_vertices(std::size_t count) {
    vertex_count_ += count;
    if (vertex_count_ >= kAddedBit) return End::kTooManyVertices;
    return store_.resize_vertices(vertex_count_) ? End::kDone : End::kStoreIsFull;
}

SurfaceStream::End SurfaceStream::place_vertices(std::span<const std::uint32_t> subtrees) {
    std::size_t next = vertex_count_;
    for (const std::uint32_t subtree : subtrees) {
        placed_[subtree] = {next, next + cells_.subtrees[subtree].vertex_count};
        next = placed_[subtree].end;
    }
    if (const End end = grow_vertices(next - vertex_count_); end != End::kDone) return end;
    tbb::parallel_for(std::size_t{0}, subtrees.size(), [&](std::size_t t) {
        SubtreeCells& cells = cells_.subtrees[subtrees[t]];
        const std::size_t first = placed_[subtrees[t]].first;
        store_.put_vertices(first, *cells.vertices, cells.first_vertex, cells.vertex_count);
        cells.vertices = nullptr;
        for (std::uint32_t b = octree_.subtrees[subtrees[t]].first_brick; b < brick_end(subtrees[t]); ++b)
            if (cells_.cells[b].crossed) cells_.cells[b].first_vertex += static_cast<std::uint32_t>(first);
    });
    cells_.reuse_vertices();
    return End::kDone;
}

SurfaceStream::End SurfaceStream::place_triangles(std::span<const std::uint32_t> subtrees) {
    struct First {
        std::size_t added, triangle;
    };
    std::vector<First> first(subtrees.size());
    std::size_t added = vertex_count_;
    std::size_t triangles = 0;
    for (std::size_t t = 0; t < subtrees.size(); ++t) {
        first[t] = {added, triangles};
        added += joined_[t].added.count;
        triangles += joined_[t].triangle_count();
    }
    if (const End end = grow_vertices(added - vertex_count_); end != End::kDone) return end;
    const std::span<glm::uvec3> out = store_.add_triangles(triangles);
    const VertexSpan vertices = store_.vertices();
    // All before the first triangle: corners are read with one number of the vertex behind them. They are few.
    for (std::size_t t = 0; t < subtrees.size(); ++t)
        store_.put_vertices(first[t].added, joined_[t].added, 0, joined_[t].added.count);
    tbb::parallel_for(std::size_t{0}, subtrees.size(), [&](std::size_t t) {
        const std::size_t count = joined_[t].triangle_count();
        joined_[t].write_triangles(vertices, first[t].added, out.subspan(first[t].triangle, count));
    });
    return End::kDone;
}

// Gives back what belongs to these subtrees, and with it the pages that they share with subtrees dropped before.
void SurfaceStream::drop(std::span<const std::uint32_t> subtrees) {
    for (const std::uint32_t subtree : subtrees) {
        dropped_[subtree] = true;
        statistics_.evaluations += cells_.subtrees[subtree].counts.evaluations;
        statistics_.samples += cells_.subtrees[subtree].counts.samples;
        cells_.subtrees[subtree] = {};
        const std::uint32_t first = octree_.subtrees[subtree].first_brick;
        cells_.neighbours.release(first, brick_end(subtree));
        cells_.cells.release(first, brick_end(subtree));
    }
    constexpr std::uint32_t kPageOfBricks = 1024; // more than a page holds of anything
    for (std::size_t t = 0; t < subtrees.size();) {
        std::uint32_t first = subtrees[t];
        std::uint32_t end = first + 1;
        for (++t; t < subtrees.size() && subtrees[t] == end; ++t) ++end;
        const std::uint32_t first_brick = octree_.subtrees[first].first_brick;
        const std::uint32_t end_brick = brick_end(end - 1);
        while (first > 0 && dropped_[first - 1] && first_brick - octree_.subtrees[first].first_brick < kPageOfBricks)
            --first;
        while (end < dropped_.size() && dropped_[end] && brick_end(end - 1) - end_brick < kPageOfBricks) ++end;
        empty(first, end);
    }
}

void SurfaceStream::empty(std::uint32_t first_subtree, std::uint32_t end_subtree) {
    const std::uint32_t first = octree_.subtrees[first_subtree].first_brick;
    const std::uint32_t count = brick_end(end_subtree - 1) - first;
    if (count == 0) return;
    const Brick& last = octree_.bricks[first + count - 1];
    const std::uint32_t list = octree_.bricks[first].list_begin;
    empty_pages(&octree_.lists[list], (last.list_begin + last.list_count - list) * sizeof(std::uint32_t));
    store_.release_vertices(placed_[first_subtree].first, placed_[end_subtree - 1].end);
}

} // namespace

} // namespace bricks

Result<void> make_surface_in(bricks::SurfaceStore& store, const field::Field& field, const PolygonizeOptions& options,
                             PolygonizeMode mode, Job& job, PolygonizeStatistics* statistics) {
    using End = bricks::SurfaceStream::End;
    Stopwatch watch;
    const bricks::Sizing sizing = bricks::make_sizing(field, options.detail, options.cell_mm);
    if (auto possible = check_feasible(field, sizing, options, mode); !possible) return possible;
    bricks::Octree octree = bricks::build_octree(field, sizing, job);
    if (job.cancelled()) return fail("cancelled");
    const double bricks_s = watch.lap();
    store.expect(octree.bricks.size());
    bricks::SurfaceStream stream(field, octree, store);
    const End end = stream.work(job);
    if (statistics != nullptr) {
        *statistics = stream.statistics();
        statistics->bricks = octree.bricks.size();
        statistics->bricks_s = bricks_s;
    }
    switch (end) {
    case End::kDone:
        return {};
    case End::kCancelled:
        return fail("cancelled");
    case End::kStoreIsFull:
        return fail("the surface cannot be taken further");
    case End::kTooManyVertices:
        break;
    }
    return fail("the surface has more than 2 147 483 647 vertices", {},
                options.cell_mm > 0.0 ? "raise --cell" : "lower --detail, or prune with --prune");
}

} // namespace ramus::mesh
