// A line of a skeleton as its centerline is worked out: points at equal distances along it.
#pragma once

#include "core/volume/skeletonize/branch_voxels.h"
#include "core/volume/skeletonize/voxel_graph.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <utility>
#include <vector>

namespace ramus::volume {

struct Course {
    std::vector<glm::dvec3> at;          // its nodes first and last
    std::vector<double> radius;          // at first that of the ball that fits in
    std::vector<std::uint8_t> clear;     // beyond the balls around its nodes, where the cross-section is its own
    double step = 0.0;                   // mm, between points, at first
    std::vector<std::uint32_t> point_of; // of each point of the line: the nearest of `at`

    [[nodiscard]] std::size_t last() const { return at.size() - 1; }
};

// `voxel`: mm, about the step.
[[nodiscard]] Course resampled(const VoxelGraph& graph, const VoxelGraph::Line& line, double voxel);

// The volume of a mask that is nearer to a point of a course than to others.
struct Slab {
    double volume = 0.0;    // mm^3
    glm::dvec3 moment{0.0}; // mm^4, about the point
    glm::dmat3 second{0.0}; // mm^5, about the point
    double length = 0.0;    // mm of the course
};

[[nodiscard]] std::vector<Slab> slabs_of(const Course& course, std::span<const BranchVoxels::Member> members,
                                         const VoxelSet& set);

// Calls `call(j, weight)` for the points within 2.5 `sigma` (in points) of point `i`, with the weights of a Gaussian.
template <class Call> void for_weights(std::size_t i, std::size_t count, double sigma, const Call& call) {
    const auto reach = static_cast<std::size_t>(std::ceil(2.5 * sigma));
    const double rate = 1.0 / std::max(sigma, 1e-9);
    for (std::size_t j = i > reach ? i - reach : 0; j <= std::min(i + reach, count - 1); ++j) {
        const double away = (static_cast<double>(j) - static_cast<double>(i)) * rate;
        call(j, std::exp(-0.5 * away * away));
    }
}

// Positions become the means of those within `sigma(i)` mm, narrower toward the ends, which stay.
template <class Sigma> void smooth_positions(Course& course, const Sigma& sigma) {
    std::vector<glm::dvec3> smooth = course.at;
    for (std::size_t i = 1; i < course.last(); ++i) {
        const double to_end = 0.5 * static_cast<double>(std::min(i, course.last() - i));
        glm::dvec3 sum(0.0);
        double weights = 0.0;
        for_weights(i, course.at.size(), std::min(sigma(i) / course.step, to_end), [&](std::size_t j, double weight) {
            sum += weight * course.at[j];
            weights += weight;
        });
        smooth[i] = sum / weights;
    }
    course.at = std::move(smooth);
}

} // namespace ramus::volume
