#include "app/reports/page/page_surface.h"

#include "app/reports/page/simplified_surface.h"
#include "app/session/numbers.h"
#include "core/measure/deviation/deviation.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <utility>

namespace ramus::app {

namespace {

// The usual error, in radii of the thinnest place of the branch: as far as a polygon of 16 sides, the usual detail, is
// from its circle.
constexpr double kUsualError = 0.02;
constexpr double kLargestError = 1.0;        // beyond it vessels collapse
constexpr double kStepShare = 0.01;          // of the grid, in the same radii: 40 steps for an edge of the usual detail
constexpr double kCoarseShare = 0.2;         // of the triangles, while the view moves
constexpr double kCoarseError = 0.5;         // in radii
constexpr std::size_t kCoarseFrom = 100'000; // triangles; fewer are drawn quickly as they are

std::size_t base64_bytes(std::size_t bytes) { return (bytes + 2) / 3 * 4; }

mesh::TriangleMesh as_mesh(const BranchSurface& surface, const PackedMesh& packed) {
    mesh::TriangleMesh mesh;
    mesh.positions.assign(surface.positions.begin(), surface.positions.end());
    for (glm::vec3& p : mesh.positions) // the finest grid: coarser groups lie on it within their step
        p = glm::vec3(packed.origin + packed.step_mm * glm::round((glm::dvec3(p) - packed.origin) / packed.step_mm));
    for (std::size_t i = 0; i < surface.indices.size(); i += 3)
        mesh.triangles.emplace_back(surface.indices[i], surface.indices[i + 1], surface.indices[i + 2]);
    return mesh;
}

void measure_deviation(PageSurface& made, const mesh::TriangleMesh& whole, const BranchSurface& shown, int threads) {
    auto distances = measure::deviations(whole, as_mesh(shown, made.packed), threads);
    // Vertices that no triangle uses do not count.
    std::vector<std::uint8_t> used(whole.positions.size(), 0);
    for (const glm::uvec3& t : whole.triangles)
        for (int corner = 0; corner < 3; ++corner) used[t[corner]] = 1;
    std::size_t kept = 0;
    for (std::size_t v = 0; v < used.size(); ++v)
        if (used[v] != 0) distances[kept++] = distances[v];
    const std::span<double> values(distances.data(), kept);
    made.percentile_95_mm = measure::quantile(values, 0.95);
    made.largest_deviation_mm = *std::ranges::max_element(values) + 0.5 * std::sqrt(3.0) * made.packed.widest_step_mm;
}

} // namespace

Result<PageSurface> page_surface(const mesh::TriangleMesh& mesh, const tree::Dependency& dependency,
                                 const PageSurfaceChoice& choice, const JobRange& job) {
    const BranchSurface whole = divided_by_branch(mesh, dependency);
    job.report(0.1F);
    PageSurface made;
    made.triangles_before = mesh.triangles.size();
    const GridChoice grid{choice.most_step_mm, kStepShare};
    Simplification wanted{kUsualError, choice.most_step_mm, 0.0};
    constexpr int kMostTries = 6;
    BranchSurface shown;
    for (int attempt = 0; attempt < kMostTries; ++attempt) {
        shown = simplified(whole, wanted);
        if (job.cancelled()) return fail("cancelled");
        const BranchSurface coarse =
            shown.triangles() < kCoarseFrom ? BranchSurface{} : simplified(shown, {kCoarseError, 1.0, kCoarseShare});
        made.packed = packed(shown, coarse, grid);
        job.report(0.1F + 0.5F * static_cast<float>(attempt + 1) / static_cast<float>(kMostTries));
        if (job.cancelled()) return fail("cancelled");
        const std::size_t bytes = base64_bytes(made.packed.bytes());
        if (bytes <= choice.most_bytes) {
            measure_deviation(made, mesh, shown, choice.threads);
            job.report(1.0F);
            return made;
        }
        // The size follows the triangles, and fewer of them take more bytes each.
        constexpr double kRoom = 0.93;
        const double share = kRoom * static_cast<double>(choice.most_bytes) / static_cast<double>(bytes);
        wanted.triangles = share * static_cast<double>(shown.triangles()) / static_cast<double>(whole.triangles());
        wanted.share_of_radius = std::min(kLargestError, wanted.share_of_radius * 8.0);
        made.for_size = true;
    }
    return fail("the page would be larger than its limit: the surface alone has " +
                    grouped(base64_bytes(made.packed.bytes()) / 1000) + " kB and there is room for " +
                    grouped(choice.most_bytes / 1000) + " kB",
                {}, "raise --size-limit, or lower --detail");
}

PackedMesh page_mesh(const mesh::TriangleMesh& mesh) {
    const BranchSurface whole = undivided(mesh);
    glm::vec3 lower(0.0F), upper(0.0F);
    for (std::size_t i = 0; i < whole.indices.size(); ++i) {
        const glm::vec3& p = whole.positions[whole.indices[i]];
        lower = i == 0 ? p : glm::min(lower, p);
        upper = i == 0 ? p : glm::max(upper, p);
    }
    constexpr double kError = 1.0 / 1500.0, kStep = 1.0 / 8192.0; // of the diagonal; tuned by eye on organs
    const double diagonal = double(glm::distance(lower, upper));
    return packed(simplified(whole, {0.0, kError * diagonal, 0.0}), {}, {std::max(kStep * diagonal, 1e-9), 0.0});
}

} // namespace ramus::app
