#include "core/mesh/polygonize/surface_batches.h"

#include "core/base/mapped_pages.h"
#include "core/base/stopwatch.h"

#include <oneapi/tbb/parallel_for.h>

namespace ramus::mesh::bricks {

SurfaceBatches::SurfaceBatches(const field::Field& field, Octree& octree, const LargeAllocator<std::byte>& memory,
                               SubtreeRange own)
    : field_(field), octree_(octree), own_(own), mesh_(memory), dropped_(octree.subtrees.size(), false),
      counts_(octree.subtrees.size()), places_(octree.subtrees.size()) {
    // Measured: 12.5 to 15 vertices per brick, and twice as many triangles. Unused capacity takes no physical memory.
    constexpr std::size_t kVertices = 16;
    mesh_.for_each_array([&](auto& array) { array.reserve(kVertices * octree.bricks.size()); });
    mesh_.triangles.reserve(2 * kVertices * octree.bricks.size());
}

SurfaceBatches::End SurfaceBatches::work(std::span<const SubtreeBatch> batches, Job& job) {
    constexpr float kOctree = 0.1F; // of the progress
    float progress = kOctree;
    std::size_t bricks = 0;
    for (const SubtreeBatch& batch : batches) {
        if (const End end = work(batch, JobRange(job, progress, progress)); end != End::kDone) return end;
        for (const std::uint32_t subtree : batch.fill) bricks += octree_.subtrees[subtree].brick_count;
        progress = kOctree + (1.0F - kOctree) * static_cast<float>(bricks) / static_cast<float>(octree_.bricks.size());
    }
    return End::kDone;
}

SurfaceBatches::End SurfaceBatches::work(const SubtreeBatch& batch, const JobRange& job) {
    Stopwatch watch;
    find_neighbours(octree_, batch.fill, cells_.neighbours);
    fill_subtrees(field_, octree_, batch.fill, cells_, job);
    if (job.cancelled()) return End::kCancelled;
    statistics_.cells_s += watch.lap();
    tell_walls(batch.fill);
    if (const End end = place_vertices(batch.fill); end != End::kDone) return end;
    join_subtrees(field_, octree_, batch.join, cells_, vertices_of(mesh_), joined_, job);
    if (job.cancelled()) return End::kCancelled;
    if (const End end = place_triangles(batch.join); end != End::kDone) return end;
    drop(batch.drop);
    statistics_.join_s += watch.lap();
    return End::kDone;
}

void SurfaceBatches::tell_walls(std::span<const std::uint32_t> subtrees) {
    for (const std::uint32_t subtree : subtrees) {
        if (!own_.holds(subtree)) continue;
        for (const std::uint32_t index : cells_.subtrees[subtree].walled_bricks)
            walled_.push_back(box_of_brick(octree_, index));
    }
}

SurfaceBatches::End SurfaceBatches::grow_vertices(std::size_t count) {
    if (count >= kAddedBit) return End::kTooManyVertices;
    mesh_.resize_vertices(count);
    return End::kDone;
}

SurfaceBatches::End SurfaceBatches::place_vertices(std::span<const std::uint32_t> subtrees) {
    std::vector<std::size_t> placed{mesh_.positions.size()};
    for (const std::uint32_t subtree : subtrees)
        placed.push_back(placed.back() + cells_.subtrees[subtree].vertex_count);
    if (const End end = grow_vertices(placed.back()); end != End::kDone) return end;
    tbb::parallel_for(std::size_t{0}, subtrees.size(), [&](std::size_t t) {
        SubtreeCells& cells = cells_.subtrees[subtrees[t]];
        copy_vertices(*cells.vertices, cells.first_vertex, mesh_, placed[t], cells.vertex_count);
        counts_[subtrees[t]].vertices = static_cast<std::uint32_t>(cells.vertex_count);
        places_[subtrees[t]].vertices = placed[t];
        cells.vertices = nullptr;
        for (std::uint32_t b = octree_.subtrees[subtrees[t]].first_brick; b < brick_end(subtrees[t]); ++b)
            if (cells_.cells[b].crossed) cells_.cells[b].first_vertex += static_cast<std::uint32_t>(placed[t]);
    });
    cells_.reuse_vertices();
    return End::kDone;
}

SurfaceBatches::End SurfaceBatches::place_triangles(std::span<const std::uint32_t> subtrees) {
    struct First {
        std::size_t added, triangle;
    };
    std::vector<First> first(subtrees.size());
    std::size_t added = mesh_.positions.size();
    std::size_t triangles = mesh_.triangles.size();
    for (std::size_t t = 0; t < subtrees.size(); ++t) {
        first[t] = {added, triangles};
        counts_[subtrees[t]].added = static_cast<std::uint32_t>(joined_[t].added.count);
        counts_[subtrees[t]].triangles = static_cast<std::uint32_t>(joined_[t].triangle_count());
        places_[subtrees[t]].added = added;
        places_[subtrees[t]].triangles = triangles;
        added += joined_[t].added.count;
        triangles += joined_[t].triangle_count();
    }
    if (const End end = grow_vertices(added); end != End::kDone) return end;
    mesh_.triangles.resize(triangles);
    // All before the first triangle: corners are read with one number of the vertex behind them. They are few.
    for (std::size_t t = 0; t < subtrees.size(); ++t)
        copy_vertices(joined_[t].added, 0, mesh_, first[t].added, joined_[t].added.count);
    tbb::parallel_for(std::size_t{0}, subtrees.size(), [&](std::size_t t) {
        joined_[t].write_triangles(vertices_of(mesh_), first[t].added,
                                   std::span(mesh_.triangles).subspan(first[t].triangle, joined_[t].triangle_count()));
    });
    return End::kDone;
}

// Frees the memory of these subtrees, and pages that they share with subtrees dropped before.
void SurfaceBatches::drop(std::span<const std::uint32_t> subtrees) {
    for (const std::uint32_t subtree : subtrees) {
        dropped_[subtree] = true;
        const SampleCounts& counts = cells_.subtrees[subtree].counts;
        if (own_.holds(subtree))
            statistics_.evaluations += counts.evaluations, statistics_.samples += counts.samples;
        else
            border_evaluations_ += counts.evaluations;
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

void SurfaceBatches::empty(std::uint32_t first_subtree, std::uint32_t end_subtree) {
    const std::uint32_t first = octree_.subtrees[first_subtree].first_brick;
    const std::uint32_t count = brick_end(end_subtree - 1) - first;
    if (count == 0) return;
    const Brick& last = octree_.bricks[first + count - 1];
    const std::uint32_t list = octree_.bricks[first].list_begin;
    empty_pages(&octree_.lists[list], (last.list_begin + last.list_count - list) * sizeof(std::uint32_t));
}

Result<void> result_of(SurfaceBatches::End end, const PolygonizeOptions& options) {
    if (end == SurfaceBatches::End::kCancelled) return fail("cancelled");
    if (end == SurfaceBatches::End::kTooManyVertices)
        return fail("the surface has more than 2 147 483 647 vertices", {},
                    options.cell_mm > 0.0 ? "raise --cell" : "lower --detail, or prune with --prune");
    return {};
}

} // namespace ramus::mesh::bricks
