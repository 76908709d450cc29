#include "app/reports/page/page_surface.h"

#include "app/reports/page/simplified_surface.h"
#include "app/session/numbers.h"
#include "core/measure/deviation/deviation.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <tbb/parallel_for.h>
#include <unordered_map>
#include <utility>

namespace ramus::app {

namespace {

// The usual error, in radii of the thinnest place of the branch: no more than two and a half times as far as a polygon
// of 16 sides, the usual detail, is from its circle.
constexpr double kUsualError = 0.05;
// Browsers draw so many triangles at rest without a graphics card; fewer would show their edges for nothing.
constexpr std::size_t kShownWhole = 300'000;
constexpr double kStepShare = 0.01; // of the grid, in the same radii: 40 steps for an edge of the usual detail
// While the view moves: what a browser without a graphics card draws ten times a second.
constexpr double kCoarseTriangles = 40'000.0;
constexpr double kCoarseError = 0.5; // in radii

std::size_t base64_bytes(std::size_t bytes) { return (bytes + 2) / 3 * 4; }

// The triangles of a branch, as a mesh.
mesh::TriangleMesh mesh_of(const BranchSurface& surface, const std::vector<glm::vec3>& positions, std::size_t rank) {
    mesh::TriangleMesh mesh;
    std::unordered_map<std::uint32_t, std::uint32_t> numbers;
    const auto number = [&](std::uint32_t v) {
        const auto [at, is_new] = numbers.try_emplace(v, static_cast<std::uint32_t>(mesh.positions.size()));
        if (is_new) mesh.positions.push_back(positions[v]);
        return at->second;
    };
    for (std::size_t i = 3 * std::size_t{surface.first[rank]}; i < 3 * std::size_t{surface.first[rank + 1]}; i += 3) {
        const std::uint32_t a = number(surface.indices[i]), b = number(surface.indices[i + 1]);
        mesh.triangles.emplace_back(a, b, number(surface.indices[i + 2]));
    }
    return mesh;
}

// Each branch by itself: distances to the triangles of the own branch, which are no less than those to all.
void measure_deviation(PageSurface& made, const BranchSurface& whole, const BranchSurface& shown) {
    const std::size_t ranks = whole.first.size() - 1;
    std::vector<std::vector<double>> found(ranks);
    tbb::parallel_for(std::size_t{0}, ranks, [&](std::size_t rank) {
        const mesh::TriangleMesh before = mesh_of(whole, whole.positions, rank);
        const mesh::TriangleMesh after = mesh_of(shown, made.packed.places, rank);
        if (before.triangles.empty()) return;
        const auto distances = measure::deviations(before, after, 1);
        found[rank].assign(distances.begin(), distances.end());
    });
    std::vector<double> all;
    for (std::vector<double>& one : found) {
        all.insert(all.end(), one.begin(), one.end());
        std::vector<double>().swap(one);
    }
    if (all.empty()) return;
    made.largest_deviation_mm = *std::ranges::max_element(all);
    made.percentile_95_mm = measure::quantile(all, 0.95);
}

bool loses_branch(const BranchSurface& whole, const BranchSurface& shown) {
    for (std::size_t rank = 0; rank + 1 < whole.first.size(); ++rank)
        if (whole.first[rank] < whole.first[rank + 1] && shown.first[rank] == shown.first[rank + 1]) return true;
    return false;
}

} // namespace

Result<PageSurface> page_surface(const mesh::TriangleMesh& mesh, const tree::Dependency& dependency,
                                 const PageSurfaceChoice& choice, const JobRange& job) {
    const BranchSurface whole = divided_by_branch(mesh, dependency);
    job.report(0.1F);
    PageSurface made;
    made.triangles_before = mesh.triangles.size();
    const GridChoice grid{choice.most_step_mm, kStepShare};
    BranchSurface shown = whole.triangles() <= kShownWhole
                              ? ordered(whole)
                              : simplified(whole, {kUsualError, choice.most_step_mm, false, 0.0});
    constexpr int kMostTries = 6;
    for (int attempt = 0; attempt < kMostTries; ++attempt) {
        if (job.cancelled()) return fail("cancelled");
        const double share = kCoarseTriangles / static_cast<double>(shown.triangles());
        const BranchSurface coarse =
            share > 0.7 ? BranchSurface{} : simplified(shown, {kCoarseError, 1.0, true, share});
        made.packed = packed(shown, coarse, grid);
        job.report(0.1F + 0.5F * static_cast<float>(attempt + 1) / static_cast<float>(kMostTries));
        const std::size_t bytes = base64_bytes(made.packed.bytes());
        if (bytes <= choice.most_bytes) {
            measure_deviation(made, whole, shown);
            job.report(1.0F);
            return made;
        }
        // Fewer triangles take more bytes each.
        constexpr double kRoom = 0.93;
        shown = simplified_together(shown, kRoom * static_cast<double>(choice.most_bytes) / static_cast<double>(bytes));
        made.for_size = true;
        if (loses_branch(whole, shown)) break;
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
    return packed(simplified(whole, {0.0, kError * diagonal, false, 0.0}), {}, {std::max(kStep * diagonal, 1e-9), 0.0});
}

} // namespace ramus::app
