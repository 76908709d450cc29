#include "core/validate/kernels.h"

#include "core/field/kernel.h"
#include "core/measure/deviation/deviation.h"
#include "core/mesh/connectivity.h"
#include "core/mesh/surface.h"
#include "core/mesh/tree_field.h"

#include <array>
#include <utility>

namespace ramus::validate {

namespace {

using field::KernelKind;

// The polynomial of width 3 blends about as far as the Gaussian of width 5. Cauchy's kernel blends farther at every
// width.
constexpr std::array<std::pair<KernelKind, double>, 11> kCompared = {{{KernelKind::kGaussian, 1.0},
                                                                      {KernelKind::kGaussian, 2.0},
                                                                      {KernelKind::kGaussian, 5.0},
                                                                      {KernelKind::kGaussian, 8.0},
                                                                      {KernelKind::kInverseSquare, 0.0},
                                                                      {KernelKind::kInverseCubic, 0.0},
                                                                      {KernelKind::kCauchy, 1.0},
                                                                      {KernelKind::kCauchy, 5.0},
                                                                      {KernelKind::kPolynomial, 1.0},
                                                                      {KernelKind::kPolynomial, 3.0},
                                                                      {KernelKind::kPolynomial, 5.0}}};

Result<KernelFigures> figures_of(std::pair<KernelKind, double> kernel, const tree::VesselTree& source,
                                 mesh::SurfaceOptions options, const mesh::TriangleMesh& cones, Job& job) {
    options.kernel = kernel.first;
    options.width = kernel.second > 0.0 ? kernel.second : options.width;
    options.blend = mesh::Blend::kPaper; // keeping vessels apart would hide what a kernel merges
    KernelFigures found;
    found.kind = kernel.first, found.width = kernel.second;
    const field::Kernel made = mesh::kernel_of(options);
    found.support_radii = made.support_radii;
    found.joints = joint_figures(made);
    RAMUS_TRY(surface, mesh::make_surface(source, options, job));
    RAMUS_TRY(validation, validate(source, surface.mesh, {made.limits, options.threads}, job));
    found.radius_error = validation.radius_error;
    found.merged = validation.merged.size();
    LargeArray<double> distances = measure::deviations(surface.mesh, cones, options.threads);
    const measure::DeviationStatistics to_cones = measure::statistics_of(distances, {});
    found.to_cones_mean_mm = to_cones.mean, found.to_cones_max_mm = to_cones.max;
    const mesh::Connectivity shape = mesh::connectivity_of(surface.mesh);
    found.pieces = shape.pieces, found.loops = shape.loops;
    found.evaluations = surface.statistics.evaluations, found.triangles = surface.mesh.triangles.size();
    found.mesh_s = surface.statistics.seconds;
    return found;
}

} // namespace

Result<ComparedKernels> compare_kernels(const tree::VesselTree& source, const mesh::SurfaceOptions& options, Job& job) {
    mesh::SurfaceOptions of_cones = options;
    of_cones.method = mesh::Method::kTruncatedCones;
    RAMUS_TRY(cones, mesh::make_surface(source, of_cones, job));
    ComparedKernels compared;
    compared.graph_loops = source.loop_count;
    compared.graph_pieces = static_cast<long>(source.roots.size());
    for (const auto& kernel : kCompared) {
        job.report(static_cast<float>(compared.kernels.size()) / static_cast<float>(kCompared.size()));
        if (job.cancelled()) return fail("cancelled");
        RAMUS_TRY(figures, figures_of(kernel, source, options, cones.mesh, job));
        compared.kernels.push_back(figures);
    }
    return compared;
}

} // namespace ramus::validate
