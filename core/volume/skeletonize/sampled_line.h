// SampledLine: a line of a skeleton, resampled to points at equal distances, from which its centerline is computed.
// Slab: the moments of the volume around each point. Positions are in mm along the mask's axes, from its first voxel.
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

struct SampledLine {
    std::vector<glm::dvec3> at;          // the first and the last are nodes
    std::vector<double> radius;          // mm; initially of the inscribed ball
    std::vector<std::uint8_t> clear;     // 1: away from the nodes, where the cross-section belongs to this line alone
    double step = 0.0;                   // mm between points after resampling
    std::vector<std::uint32_t> point_of; // by point of the line: index of the nearest of `at`

    [[nodiscard]] std::size_t last() const { return at.size() - 1; }
};

// Resamples a line to steps of about `voxel` mm. `clear` stays empty.
[[nodiscard]] SampledLine resampled(const VoxelGraph& graph, const VoxelGraph::Line& line, double voxel);

// The moments of the part of a mask that is nearest to one point of a SampledLine.
struct Slab {
    double volume = 0.0;    // mm^3
    glm::dvec3 moment{0.0}; // mm^4, about the point
    glm::dmat3 second{0.0}; // mm^5, about the point
    double length = 0.0;    // mm of the line
};

// The slab of each point, from the voxels `members` of the line.
[[nodiscard]] std::vector<Slab> slabs_of(const SampledLine& sampled, std::span<const BranchVoxels::Member> members,
                                         const VoxelSet& set);

// Calls `call(j, weight)` for the points within 2.5 `sigma` of point `i`, with the weights of a Gaussian. `sigma`
// counts in points.
template <class Call> void for_weights(std::size_t i, std::size_t count, double sigma, const Call& call) {
    const auto reach = static_cast<std::size_t>(std::ceil(2.5 * sigma));
    const double rate = 1.0 / std::max(sigma, 1e-9);
    for (std::size_t j = i > reach ? i - reach : 0; j <= std::min(i + reach, count - 1); ++j) {
        const double away = (static_cast<double>(j) - static_cast<double>(i)) * rate;
        call(j, std::exp(-0.5 * away * away));
    }
}

// Smooths positions by a Gaussian of `sigma(i)` mm, narrower toward the ends. The end points stay.
template <class Sigma> void smooth_positions(SampledLine& sampled, const Sigma& sigma) {
    std::vector<glm::dvec3> smooth = sampled.at;
    for (std::size_t i = 1; i < sampled.last(); ++i) {
        const double to_end = 0.5 * static_cast<double>(std::min(i, sampled.last() - i));
        glm::dvec3 sum(0.0);
        double weights = 0.0;
        for_weights(i, sampled.at.size(), std::min(sigma(i) / sampled.step, to_end), [&](std::size_t j, double weight) {
            sum += weight * sampled.at[j];
            weights += weight;
        });
        smooth[i] = sum / weights;
    }
    sampled.at = std::move(smooth);
}

} // namespace ramus::volume
