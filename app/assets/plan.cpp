#include "app/assets/plan.h"

#include "app/assets/assets.h"
#include "core/base/bounds.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <limits>
#include <oneapi/tbb/parallel_for.h>
#include <utility>

namespace ramus::app {

namespace {

constexpr double kMostSamples = 250'000; // tuned: see distance_grid()

std::shared_ptr<const render::DistanceGrid> make_grid(const measure::Lesions& lesions, double reach_mm) {
    Bounds<glm::dvec3> box;
    for (const auto& mesh : lesions.meshes)
        for (const glm::dvec3& corner : {mesh->bounds().least, mesh->bounds().most}) box.hold(corner);
    auto grid = std::make_shared<render::DistanceGrid>();
    const glm::dvec3 extent = box.size() + 2.0 * reach_mm;
    grid->step_mm = std::cbrt(extent.x * extent.y * extent.z / kMostSamples);
    grid->size = glm::ivec3(glm::ceil(extent / grid->step_mm)) + 2;
    grid->corner = box.least - reach_mm - 0.5 * grid->step_mm;
    const glm::ivec3 n = grid->size;
    grid->values.resize(std::size_t(n.x) * std::size_t(n.y) * std::size_t(n.z));
    oneapi::tbb::parallel_for(0, n.y * n.z, [&](int row) {
        for (int x = 0; x < n.x; ++x) {
            const glm::dvec3 at = grid->corner + grid->step_mm * glm::dvec3(x, row % n.y, row / n.y);
            double nearest = std::numeric_limits<double>::max();
            for (const auto& mesh : lesions.meshes) nearest = std::min(nearest, mesh->distance(at));
            grid->values[std::size_t(row) * std::size_t(n.x) + std::size_t(x)] = static_cast<float>(nearest);
        }
    });
    return grid;
}

// Unread meshes are numbered, too.
std::vector<measure::LesionVessels> numbered(std::vector<measure::LesionVessels> vessels,
                                             const measure::Lesions& lesions,
                                             const std::vector<std::shared_ptr<const LesionMesh>>& meshes) {
    std::vector<std::size_t> numbers;
    for (std::size_t i = 0; i < lesions.spheres.size() + meshes.size(); ++i)
        if (i < lesions.spheres.size() || meshes[i - lesions.spheres.size()]) numbers.push_back(i);
    for (measure::LesionVessels& one : vessels) one.lesion = numbers[one.lesion];
    return vessels;
}

} // namespace

LesionDistances measure_lesions(const tree::VesselTree& tree, measure::Lesions lesions, double touch_mm) {
    std::vector<double> mm = measure::wall_distances(tree, lesions);
    std::vector<measure::LesionVessels> vessels = measure::lesion_vessels(tree, lesions, touch_mm);
    return {std::move(lesions), touch_mm, std::move(mm), std::move(vessels)};
}

measure::Lesions loaded_lesions(const Assets& assets, const Marks& marks) {
    measure::Lesions lesions{spheres_of(marks), {}};
    for (const Lesion& lesion : lesion_meshes(marks))
        if (const auto mesh = assets.lesion_mesh(lesion)) lesions.meshes.push_back(mesh->distance);
    return lesions;
}

PlannedMarks planned(const Marks& marks) {
    return {spheres_of(marks), lesion_meshes(marks), marks.cuts, marks.planning};
}

Plan make_plan(const Assets& assets, const Marks& marks) {
    Plan plan;
    plan.of = planned(marks);
    plan.lesions = loaded_lesions(assets, marks);
    for (const Lesion& lesion : plan.of.lesion_meshes) {
        plan.meshes.push_back(assets.lesion_mesh(lesion));
        if (!assets.lesion_files.contains(source_of(lesion)))
            plan.measuring = true;
        else if (const auto trouble = assets.trouble(lesion);
                 trouble && std::ranges::find(plan.troubles, trouble->message()) == plan.troubles.end())
            plan.troubles.push_back(trouble->message());
    }
    const double touch_mm = marks.planning.touch_mm;
    const LesionDistances& known = assets.lesion_distances;
    const bool fits = known.fits(plan.lesions, touch_mm);
    if (!fits && !plan.lesions.meshes.empty()) {
        plan.measuring = true;
        plan.lesions.meshes.clear();
    }
    if (!plan.lesions.empty()) {
        const LesionDistances now = fits ? known : measure_lesions(*assets.tree, plan.lesions, touch_mm);
        plan.lesion_distances_mm = now.mm;
        plan.measured_vessels = now.vessels;
        plan.vessels = numbered(now.vessels, plan.lesions, plan.meshes);
    }
    const TreeFacts& facts = *assets.facts;
    if (!plan.lesion_distances_mm.empty())
        plan.bands =
            measure::band_table(plan.lesion_distances_mm, marks.planning.bands_mm, facts.statistics, facts.dependents);
    plan.cuts = measure::cut_report(*assets.tree, facts.dependency, facts.dependents, marks.cuts,
                                    marks.planning.reconstruct_mm);
    return plan;
}

std::vector<glm::dvec3> ring_around(const glm::dvec3& centre, const glm::dvec3& axis, double radius_mm) {
    const glm::dvec3 other = std::abs(axis.z) < 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0);
    const glm::dvec3 u = glm::normalize(glm::cross(axis, other)), v = glm::cross(axis, u);
    constexpr int kSteps = 72;
    std::vector<glm::dvec3> points;
    for (int i = 0; i <= kSteps; ++i) {
        const double angle = glm::two_pi<double>() * (i % kSteps) / kSteps;
        points.push_back(centre + radius_mm * (std::cos(angle) * u + std::sin(angle) * v));
    }
    return points;
}

double widest_margin_mm(const Planning& planning) {
    const auto& bands = planning.bands_mm;
    return bands.empty() ? 0.0 : bands[std::min(bands.size(), render::Margins::kMost) - 1];
}

LesionGrid distance_grid(const measure::Lesions& lesions, double reach_mm) {
    return {lesions.meshes, reach_mm, make_grid(lesions, reach_mm)};
}

} // namespace ramus::app
