#include "app/workspace/deviation_maker.h"

#include "app/assets/half_turn.h"
#include "app/session/error_context.h"
#include "app/workspace/compared_surfaces.h"
#include "core/io/meshes/mesh_file.h"
#include "core/measure/deviation/deviation.h"
#include "core/measure/deviation/packed_triangles.h"

#include <algorithm>
#include <cmath>
#include <oneapi/tbb/task_arena.h>
#include <vector>

namespace ramus::app {

namespace {

// The other surface, and the diagonal of its voxels if it is an isosurface.
struct OtherSurface {
    mesh::TriangleMesh mesh;
    std::optional<double> voxel_mm;
};

// Triangles around cones are finer than for pictures, because their chords lie below the cones, which would be visible
// as stripes. Uses as many as are quick to measure from; a cone with its half-spheres has about half the square of this
// number.
int detail_of_cones(const DeviationOf& of) {
    constexpr double kMostTriangles = 8e6, kFinest = 48.0;
    const double segments = std::max(1.0, static_cast<double>(of.tree->segment_count()));
    return std::max(of.options->detail,
                    static_cast<int>(std::min(kFinest, std::sqrt(2.0 * kMostTriangles / segments))));
}

ComparedRequest request_of(const DeviationOf& of, int threads, std::size_t memory_bytes) {
    ComparedRequest request;
    const bool cones = of.from == DeviationChoice::From::kCones;
    request.kind = cones ? Compared::kTruncatedCones : Compared::kIsosurface;
    if (cones) {
        request.surface = {*of.options, of.hidden};
        request.surface.options.method = mesh::Method::kTruncatedCones;
        request.surface.options.detail = detail_of_cones(of);
    }
    request.surface.options.threads = threads;
    request.surface.options.memory_bytes = memory_bytes;
    request.mask = cones ? std::string() : of.file;
    request.units = of.units;
    request.labels = of.labels;
    return request;
}

Result<OtherSurface> other_surface(const DeviationOf& of, int threads, std::size_t memory_bytes, Job& job) {
    if (of.from == DeviationChoice::From::kFile) {
        RAMUS_TRY(read, io::read_mesh_file(of.file, {io::Holes::kAllowed, io::slicer_space(of.axes)}));
        if (lies_elsewhere(read.mesh, *of.tree)) {
            const std::string hint =
                half_turn_hint({render::bounds_of(read.mesh), read.axes},
                               {render::bounds_of(*of.tree), of.tree->claims.orientation}, other_axes_option(of.axes));
            if (!hint.empty()) return fail(hint, of.file);
            return fail("this surface lies elsewhere than the tree", of.file,
                        "give a surface in the coordinates of the tree, in mm");
        }
        return OtherSurface{std::move(read.mesh), {}};
    }
    RAMUS_TRY(made, compared_mesh(*of.tree, request_of(of, threads, memory_bytes), job));
    return OtherSurface{std::move(made.mesh), made.voxel_diagonal_mm};
}

// In blocks, to allow cancelling and progress. Unused vertices have no distance.
Result<LargeArray<float>> distances_of(const render::PagedMesh& mesh, const measure::PackedTriangles& other,
                                       const JobRange& job) {
    constexpr std::size_t kStretch = 1U << 17U;
    const std::vector<std::uint32_t> used = mesh.used_vertices();
    LargeArray<float> values(used.empty() ? 0 : used.back() + 1, render::kNotKnown);
    std::vector<glm::vec3> points;
    for (std::size_t first = 0; first < used.size(); first += kStretch) {
        if (job.cancelled()) return fail("cancelled");
        const std::size_t count = std::min(kStretch, used.size() - first);
        points.clear();
        for (std::size_t i = first; i < first + count; ++i) points.push_back(mesh.position(used[i]));
        const LargeArray<double> found = other.distances(points);
        for (std::size_t i = 0; i < count; ++i) values[used[first + i]] = static_cast<float>(found[i]);
        job.report(static_cast<float>(first + count) / static_cast<float>(used.size()));
    }
    return values;
}

void summarise(const LargeArray<float>& values, SurfaceDeviation& deviation) {
    std::vector<double> known;
    for (const float value : values)
        if (value > render::kLeastKnown) known.push_back(value);
    if (known.empty()) return;
    double sum = 0.0;
    for (const double value : known) sum += value;
    deviation.mean_mm = sum / static_cast<double>(known.size());
    deviation.most_mm = std::ranges::max(known);
    deviation.percentile_95_mm = measure::quantile(known, 0.95);
    deviation.percentile_99_mm = measure::quantile(known, 0.99);
}

Result<SurfaceDeviation> measured_from(const OtherSurface& other, SurfaceDeviation deviation, Job& job) {
    constexpr float kPacked = 0.3F, kMesh = 0.9F; // shares of the job's progress
    const measure::PackedTriangles triangles(other.mesh);
    RAMUS_TRY(values, distances_of(*deviation.mesh, triangles, JobRange(job, kPacked, kMesh)));
    summarise(values, deviation);
    deviation.voxel_mm = other.voxel_mm;
    deviation.valued_mesh = render::shared(deviation.mesh->with_values(values));
    if (!deviation.preview) return deviation;
    RAMUS_TRY(of_preview, distances_of(*deviation.preview, triangles, JobRange(job, kMesh, 1.0F)));
    deviation.valued_preview = render::shared(deviation.preview->with_values(of_preview));
    return deviation;
}

} // namespace

Result<SurfaceDeviation> make_deviation(const DeviationOf& of, int threads, std::size_t memory_bytes,
                                        const SurfaceDeviation::Paged& mesh, const SurfaceDeviation::Paged& preview,
                                        Job& job) {
    SurfaceDeviation deviation;
    deviation.of = of;
    deviation.mesh = mesh;
    deviation.preview = preview;
    if (mesh->triangle_count() == 0) { // all branches are hidden
        deviation.valued_mesh = mesh;
        return deviation;
    }
    RAMUS_TRY(other, other_surface(of, threads, memory_bytes, job));
    if (other.mesh.triangles.empty()) return fail("the other surface has no triangles", of.file, "choose another one");
    if (job.cancelled()) return fail("cancelled");
    tbb::task_arena arena(threads > 0 ? threads : tbb::task_arena::automatic);
    return arena.execute([&] { return measured_from(other, std::move(deviation), job); });
}

} // namespace ramus::app
