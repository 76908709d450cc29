#include "core/mesh/polygonize/polygonize.h"

#include "core/base/stopwatch.h"
#include "core/mesh/polygonize/feasible.h"
#include "core/mesh/polygonize/surface_batches.h"

namespace ramus::mesh {

Result<TriangleMesh> polygonize(const field::Field& field, const PolygonizeOptions& options, Job& job,
                                PolygonizeStatistics* statistics, std::vector<Bounds<glm::vec3>>* walled) {
    if (auto some = check_segments(field); !some) return tl::unexpected(some.error());
    Stopwatch watch;
    const LargeAllocator<std::byte> memory(options.disk);
    const bricks::Sizing sizing = bricks::make_sizing(field, options.detail, options.cell_mm, memory);
    const PolygonizeMode mode = options.disk != nullptr ? PolygonizeMode::kOnDisk : PolygonizeMode::kWhole;
    if (auto possible = check_feasible(field, sizing, options, mode); !possible)
        return tl::unexpected(possible.error());
    bricks::Octree octree = bricks::build_octree(field, sizing, job, memory);
    if (job.cancelled()) return fail("cancelled");
    const double bricks_s = watch.lap();
    bricks::SurfaceBatches batches(field, octree, memory);
    const auto end = batches.work(bricks::schedule_subtrees(octree), job);
    if (statistics != nullptr) {
        *statistics = batches.statistics();
        statistics->bricks = octree.bricks.size();
        statistics->bricks_s = bricks_s;
    }
    if (auto ended = bricks::result_of(end, options); !ended) return tl::unexpected(ended.error());
    job.report(1.0F);
    if (walled != nullptr) *walled = batches.take_walled();
    return batches.take();
}

} // namespace ramus::mesh
