#include "core/measure/lesion_distance.h"

#include "core/base/infinity.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace ramus::measure {

namespace {

// The minimum of |c - p| - r over the segment. It is convex along the segment. At the minimum, the segment's tangent
// cone is perpendicular to the way to c.
double to_wall(const glm::dvec3& c, const tree::Point& a, const tree::Point& b) {
    const double at_a = glm::distance(c, a.position) - a.radius;
    const double at_b = glm::distance(c, b.position) - b.radius;
    const double length = glm::distance(a.position, b.position);
    const double slope = length > 0.0 ? (b.radius - a.radius) / length : 0.0;
    const double ends = std::min(at_a, at_b);
    if (length <= 0.0 || std::abs(slope) >= 1.0) return ends; // one end's ball holds the other
    const glm::dvec3 along = (b.position - a.position) / length;
    const double foot = glm::dot(c - a.position, along);
    const double off = glm::length(c - a.position - foot * along);
    const double t = foot + slope * off / std::sqrt(1.0 - slope * slope);
    if (t <= 0.0 || t >= length) return ends;
    return std::min(ends, std::hypot(off, t - foot) - (a.radius + slope * t));
}

// Skips segments that cannot be nearer than `best`, since a distance changes by at most the length of a segment.
double to_mesh(const tree::VesselTree& tree, const tree::Branch& branch, const MeshDistance& mesh, double best) {
    if (mesh.inside(tree.points[branch.points.front()].position)) return 0.0;
    double at_start = mesh.surface_distance(tree.points[branch.points.front()].position); // or less
    bool exact = true;
    best = std::min(best, at_start - tree.points[branch.points.front()].radius);
    for (std::size_t i = 1; i < branch.points.size() && best > 0.0; ++i) {
        const tree::Point& a = tree.points[branch.points[i - 1]];
        const tree::Point& b = tree.points[branch.points[i]];
        const double length = glm::distance(a.position, b.position);
        const auto out_of_reach = [&] { return at_start - length - std::max(a.radius, b.radius) >= best; };
        if (!exact && !out_of_reach()) {
            at_start = mesh.surface_distance(a.position);
            best = std::min(best, at_start - a.radius);
        }
        exact = !out_of_reach();
        if (exact) {
            at_start = mesh.surface_distance(b.position); // of the next one
            best = mesh.wall_distance(a, b, std::min(best, at_start - b.radius));
        } else {
            at_start -= length;
        }
    }
    return best;
}

double branch_distance(const tree::VesselTree& tree, const tree::Branch& branch, const Lesions& lesions) {
    double best = kInfinity;
    for (std::size_t i = 1; i < branch.points.size() && best > 0.0; ++i)
        for (const auto& [x, y, z, radius] : lesions.spheres)
            best = std::min(best, to_wall({x, y, z}, tree.points[branch.points[i - 1]], tree.points[branch.points[i]]) -
                                      radius);
    for (const auto& mesh : lesions.meshes)
        if (best > 0.0) best = to_mesh(tree, branch, *mesh, best);
    return std::max(best, 0.0);
}

} // namespace

double lesion_distance(const Lesions& lesions, const glm::dvec3& point) {
    double best = kInfinity;
    for (const auto& [x, y, z, radius] : lesions.spheres)
        best = std::min(best, glm::distance(point, glm::dvec3(x, y, z)) - radius);
    for (const auto& mesh : lesions.meshes) best = std::min(best, mesh->distance(point));
    return std::max(best, 0.0);
}

std::vector<double> wall_distances(const tree::VesselTree& tree, const Lesions& lesions) {
    std::vector<double> distances(tree.branches.size(), kInfinity);
    if (lesions.empty()) return distances;
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, distances.size(), 64), [&](const auto& range) {
        for (std::size_t b = range.begin(); b < range.end(); ++b)
            distances[b] = branch_distance(tree, tree.branches[b], lesions);
    });
    return distances;
}

std::vector<Band> band_table(std::span<const double> distances_mm, std::span<const double> bands_mm,
                             const TreeStatistics& statistics, std::span<const Amount> dependents) {
    std::vector<Band> bands;
    double from = 0.0;
    for (const double to : bands_mm) {
        bands.push_back({from, to, {}});
        from = to;
    }
    for (std::size_t b = 0; b < distances_mm.size(); ++b) {
        const auto band = std::ranges::lower_bound(bands_mm, distances_mm[b]);
        if (band == bands_mm.end()) continue;
        bands[static_cast<std::size_t>(band - bands_mm.begin())].rows.push_back(
            {static_cast<int>(b), distances_mm[b], statistics.branches[b].diameter_mm.mean, dependents[b]});
    }
    for (Band& band : bands) std::ranges::stable_sort(band.rows, std::ranges::greater{}, &BandRow::mean_diameter_mm);
    return bands;
}

} // namespace ramus::measure
