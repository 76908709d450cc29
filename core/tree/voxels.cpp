#include "core/tree/voxels.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <vector>

namespace ramus::tree {

namespace {

constexpr double kRounding = 0.05; // of a step: files have rounded numbers
constexpr double kNearlyAll = 0.95;
constexpr double kTurning = 0.1;       // least share of inner points that turn: a straight line shows no grid
constexpr std::size_t kFewest = 30;    // segments
constexpr double kThinnestRadii = 0.4; // of a step, the median radius: a vessel is a voxel thick

// The vectors from each point to the next one, branch by branch.
struct Steps {
    std::vector<glm::dvec3> all;
    std::size_t inner = 0, turning = 0; // points between two of a branch; those where its steps differ
};

Steps steps_of(const VesselTree& tree) {
    Steps steps;
    steps.all.reserve(tree.segment_count());
    for (const Branch& branch : tree.branches)
        for (std::size_t i = 1; i < branch.points.size(); ++i) {
            const glm::dvec3 step = tree.points[branch.points[i]].position - tree.points[branch.points[i - 1]].position;
            if (i > 1) {
                ++steps.inner;
                if (glm::distance(step, steps.all.back()) > kRounding * glm::length(step)) ++steps.turning;
            }
            steps.all.push_back(step);
        }
    return steps;
}

// The step length along one axis; 0: no step changes this coordinate. None: the steps have different lengths.
std::optional<double> step_along(const std::vector<glm::dvec3>& steps, int axis) {
    double longest = 0.0;
    for (const glm::dvec3& step : steps) longest = std::max(longest, std::abs(step[axis]));
    std::vector<double> lengths;
    for (const glm::dvec3& step : steps)
        if (const double length = std::abs(step[axis]); length > 1e-6 * longest) lengths.push_back(length);
    if (lengths.empty()) return 0.0;
    const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
    std::ranges::nth_element(lengths, middle);
    const double usual = *middle;
    const auto alike =
        std::ranges::count_if(lengths, [&](double length) { return std::abs(length - usual) <= kRounding * usual; });
    if (static_cast<double>(alike) < kNearlyAll * static_cast<double>(lengths.size())) return std::nullopt;
    return usual;
}

double median_radius(const VesselTree& tree) {
    std::vector<double> radii;
    for (const Point& point : tree.points) radii.push_back(point.radius);
    const auto middle = radii.begin() + static_cast<std::ptrdiff_t>(radii.size() / 2);
    std::ranges::nth_element(radii, middle);
    return *middle;
}

} // namespace

glm::dvec3 sizes_mm(const Voxels& voxels) {
    return {glm::length(voxels.edges_mm[0]), glm::length(voxels.edges_mm[1]), glm::length(voxels.edges_mm[2])};
}

double mean_size_mm(const Voxels& voxels) { return std::cbrt(std::abs(glm::determinant(voxels.edges_mm))); }

bool is_a_voxel(const glm::dmat3& edges_mm) {
    const glm::dvec3 sizes = sizes_mm({edges_mm, false});
    const double box = sizes.x * sizes.y * sizes.z;
    return std::isfinite(box) && box > 0.0 && std::abs(glm::determinant(edges_mm)) > 1e-3 * box;
}

std::optional<Voxels> estimated_voxels(const VesselTree& tree) {
    const Steps steps = steps_of(tree);
    if (steps.all.size() < kFewest || static_cast<double>(steps.turning) < kTurning * static_cast<double>(steps.inner))
        return std::nullopt;
    glm::dvec3 sizes(0.0);
    double largest = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
        const std::optional<double> step = step_along(steps.all, axis);
        if (!step) return std::nullopt;
        sizes[axis] = *step;
        largest = std::max(largest, *step);
    }
    if (median_radius(tree) < kThinnestRadii * largest) return std::nullopt;
    for (int axis = 0; axis < 3; ++axis)
        if (sizes[axis] == 0.0) sizes[axis] = largest; // a flat tree
    const glm::dmat3 edges(glm::dvec3(sizes.x, 0.0, 0.0), glm::dvec3(0.0, sizes.y, 0.0), glm::dvec3(0.0, 0.0, sizes.z));
    if (!is_a_voxel(edges)) return std::nullopt;
    return Voxels{edges, true};
}

} // namespace ramus::tree
