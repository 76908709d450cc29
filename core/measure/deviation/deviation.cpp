#include "core/measure/deviation/deviation.h"

#include "core/base/bounds.h"
#include "core/measure/deviation/packed_triangles.h"
#include "core/mesh/close_mesh.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <oneapi/tbb/task_arena.h>

namespace ramus::measure {

namespace {

constexpr std::size_t kBins = 64;

Histogram histogram_of(std::span<const double> values, double most) {
    Histogram histogram{most / static_cast<double>(kBins), std::vector<std::uint64_t>(kBins, 0)};
    for (const double value : values) {
        const double bin = histogram.width > 0.0 ? value / histogram.width : 0.0;
        ++histogram.counts[std::min(static_cast<std::size_t>(bin), kBins - 1)];
    }
    return histogram;
}

BoxPlot box_plot_of(std::span<double> values) {
    BoxPlot box;
    box.lower_quartile = quantile(values, 0.25);
    box.median = quantile(values, 0.5);
    box.upper_quartile = quantile(values, 0.75);
    const double reach = 1.5 * (box.upper_quartile - box.lower_quartile);
    box.lower_whisker = box.lower_quartile;
    box.upper_whisker = box.upper_quartile;
    std::size_t beyond = 0;
    for (const double value : values) {
        if (value < box.lower_quartile - reach || value > box.upper_quartile + reach) {
            ++beyond;
            continue;
        }
        box.lower_whisker = std::min(box.lower_whisker, value);
        box.upper_whisker = std::max(box.upper_whisker, value);
    }
    box.beyond = static_cast<double>(beyond) / static_cast<double>(values.size());
    return box;
}

} // namespace

LargeArray<double> deviations(const mesh::TriangleMesh& surface, const mesh::TriangleMesh& other, int threads) {
    tbb::task_arena arena(threads > 0 ? threads : tbb::task_arena::automatic);
    return arena.execute([&] { return PackedTriangles(other).distances(surface.positions); });
}

double quantile(std::span<double> values, double share) {
    const double place = share * static_cast<double>(values.size() - 1);
    const auto below = static_cast<std::size_t>(place);
    const auto at = values.begin() + static_cast<std::ptrdiff_t>(below);
    std::nth_element(values.begin(), at, values.end());
    const double low = *at;
    if (below + 1 == values.size()) return low;
    return low + (place - static_cast<double>(below)) * (*std::min_element(at + 1, values.end()) - low);
}

DeviationStatistics statistics_of(std::span<double> values, std::optional<double> threshold) {
    DeviationStatistics found;
    found.count = values.size();
    const auto count = static_cast<double>(values.size());
    double sum = 0.0, squares = 0.0;
    for (const double value : values) sum += value, squares += value * value;
    found.mean = sum / count;
    found.rms = std::sqrt(squares / count);
    double spread = 0.0;
    for (const double value : values) spread += (value - found.mean) * (value - found.mean);
    found.sigma = std::sqrt(spread / count);
    const auto [least, most] = std::ranges::minmax(values);
    found.min = least;
    found.max = most;
    if (threshold)
        found.above =
            static_cast<double>(std::ranges::count_if(values, [&](double value) { return value > *threshold; })) /
            count;
    found.histogram = histogram_of(values, most);
    found.percentile_95 = quantile(values, 0.95);
    found.box = box_plot_of(values);
    return found;
}

std::vector<std::size_t> farthest_vertices(const mesh::TriangleMesh& surface, std::span<const double> distances,
                                           std::size_t count) {
    constexpr double kLeastDistance = 0.01; // of the diagonal of the surface's box
    const auto apart = static_cast<float>(kLeastDistance) * glm::length(box_of_points(surface.positions).size());
    std::vector<std::size_t> found;
    const auto is_free = [&](const glm::vec3& at) {
        return std::ranges::none_of(found, [&](std::size_t other) {
            const glm::vec3 way = at - surface.positions[other];
            return glm::dot(way, way) < apart * apart;
        });
    };
    while (found.size() < count) {
        std::size_t farthest = distances.size();
        for (std::size_t i = 0; i < distances.size(); ++i)
            if ((farthest == distances.size() || distances[i] > distances[farthest]) && is_free(surface.positions[i]))
                farthest = i;
        if (farthest == distances.size()) break;
        found.push_back(farthest);
    }
    return found;
}

SurfaceSize size_of(const mesh::TriangleMesh& mesh) {
    SurfaceSize size;
    if (mesh.triangles.empty()) return size;
    const glm::dvec3 origin(mesh.positions[mesh.triangles.front().x]); // far from zero, little would remain
    double twice = 0.0, six_fold = 0.0;
    for (const glm::uvec3& t : mesh.triangles) {
        const glm::dvec3 a = glm::dvec3(mesh.positions[t.x]) - origin;
        const glm::dvec3 b = glm::dvec3(mesh.positions[t.y]) - origin;
        const glm::dvec3 c = glm::dvec3(mesh.positions[t.z]) - origin;
        twice += glm::length(glm::cross(b - a, c - a));
        six_fold += glm::dot(a, glm::cross(b, c));
    }
    size.area_mm2 = 0.5 * twice;
    if (mesh::check_closed(mesh, {})) size.volume_mm3 = six_fold / 6.0;
    return size;
}

} // namespace ramus::measure
