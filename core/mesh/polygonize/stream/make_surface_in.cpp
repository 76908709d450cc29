#include "core/mesh/polygonize/stream/make_surface_in.h"

#include "core/base/stopwatch.h"
#include "core/mesh/polygonize/feasible.h"
#include "core/mesh/polygonize/stream/surface_stream.h"

namespace ramus::mesh {

Result<void> make_surface_in(bricks::SurfaceStore& store, const field::Field& field, const PolygonizeOptions& options,
                             PolygonizeMode mode, Job& job, PolygonizeStatistics* statistics) {
    using bricks::SurfaceStream;
    Stopwatch watch;
    const bricks::Sizing sizing = bricks::make_sizing(field, options.detail, options.cell_mm);
    if (auto possible = check_feasible(field, sizing, options, mode); !possible) return possible;
    bricks::Octree octree = bricks::build_octree(field, sizing, job);
    if (job.cancelled()) return fail("cancelled");
    const double bricks_s = watch.lap();
    store.expect(octree.bricks.size());
    SurfaceStream stream(field, octree, store);
    const SurfaceStream::End end = stream.work(job);
    if (statistics != nullptr)
        *statistics = {stream.evaluations(), stream.samples(), octree.bricks.size(), bricks_s,
                       stream.fill_s(),      stream.join_s()};
    switch (end) {
    case SurfaceStream::End::kDone:
        return {};
    case SurfaceStream::End::kCancelled:
        return fail("cancelled");
    case SurfaceStream::End::kStoreIsFull:
        return fail("the surface cannot be taken further");
    case SurfaceStream::End::kTooManyVertices:
        break;
    }
    return fail("the surface has more than 2 147 483 647 vertices", {},
                options.cell_mm > 0.0 ? "raise --cell" : "lower --detail, or prune with --prune");
}

} // namespace ramus::mesh
