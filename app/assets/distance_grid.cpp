#include "app/assets/distance_grid.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <limits>
#include <oneapi/tbb/parallel_for.h>

namespace ramus::app {

namespace {

constexpr double kMostSamples = 250'000; // tuned: see distance_grid()

std::shared_ptr<const render::DistanceGrid> make_grid(const measure::Lesions& lesions, double reach_mm) {
    glm::dvec3 least(std::numeric_limits<double>::max()), most(-std::numeric_limits<double>::max());
    for (const auto& mesh : lesions.meshes) {
        least = glm::min(least, mesh->bounds().least);
        most = glm::max(most, mesh->bounds().most);
    }
    auto grid = std::make_shared<render::DistanceGrid>();
    const glm::dvec3 extent = most - least + 2.0 * reach_mm;
    grid->step_mm = std::cbrt(extent.x * extent.y * extent.z / kMostSamples);
    grid->size = glm::ivec3(glm::ceil(extent / grid->step_mm)) + 2;
    grid->corner = least - reach_mm - 0.5 * grid->step_mm;
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

} // namespace

double widest_margin_mm(const Planning& planning) {
    const auto& bands = planning.bands_mm;
    return bands.empty() ? 0.0 : bands[std::min(bands.size(), render::Margins::kMost) - 1];
}

LesionGrid distance_grid(const measure::Lesions& lesions, double reach_mm) {
    return {lesions.meshes, reach_mm, make_grid(lesions, reach_mm)};
}

} // namespace ramus::app
