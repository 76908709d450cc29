#include "core/mesh/surface.h"

#include "core/mesh/cones.h"
#include "core/mesh/polygonize/polygonize.h"

#include <chrono>
#include <new>
#include <oneapi/tbb/task_arena.h>

namespace ramus::mesh {

namespace {

Result<Surface> make(const tree::VesselTree& source, const SurfaceOptions& options, Job& job) {
    const auto start = std::chrono::steady_clock::now();
    const PreparedTree prepared = prepare_tree(source, options);
    Surface surface;
    if (options.method == Method::kTruncatedCones) {
        auto mesh = cones(prepared, options.detail, job);
        if (!mesh) return tl::unexpected(mesh.error());
        surface.mesh = std::move(*mesh);
    } else {
        const field::ConvolutionField field(prepared, options.width);
        PolygonizeOptions polygonize_options;
        polygonize_options.detail = options.detail;
        polygonize_options.cell_mm = options.cell_mm;
        PolygonizeStatistics statistics;
        auto mesh = polygonize(field, polygonize_options, job, &statistics);
        if (!mesh) return tl::unexpected(mesh.error());
        surface.mesh = std::move(*mesh);
        surface.statistics.evaluations = statistics.evaluations;
    }
    surface.statistics.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return surface;
}

} // namespace

Result<Surface> make_surface(const tree::VesselTree& source, const SurfaceOptions& options, Job& job) {
    try {
        if (options.threads <= 0) return make(source, options, job);
        tbb::task_arena arena(options.threads);
        return arena.execute([&] { return make(source, options, job); });
    } catch (const std::bad_alloc&) {
        return fail("not enough memory for this surface", {}, "lower --detail, raise --cell or prune the tree");
    }
}

} // namespace ramus::mesh
