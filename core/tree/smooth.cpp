#include "core/tree/smooth.h"

#include "core/base/grouped.h"
#include "core/tree/voxels.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>
#include <vector>

namespace ramus::tree {

namespace {

constexpr double kMostVoxels = 0.5; // the largest move of a point, in voxels
constexpr double kMostRadii = 0.5;  // the largest move of a point, in its radii
constexpr int kMostSteps = 64;      // points visited within one voxel: a file may claim voxels of any size

// A point with its position counted in voxels.
struct VoxelPoint {
    glm::dvec3 at{0.0};
    double radius = 0.0; // mm
};

// The number of steps between voxels that are adjacent by a face, an edge or a corner, as between the paper's points.
double steps_between(const VoxelPoint& a, const VoxelPoint& b) {
    const glm::dvec3 way = glm::abs(a.at - b.at);
    return std::max({way.x, way.y, way.z});
}

class Diffusion {
public:
    Diffusion(const VesselTree& tree, const Voxels& voxels)
        : to_voxels_(glm::inverse(voxels.edges_mm)), to_mm_(voxels.edges_mm), most_mm_(mean_size_mm(voxels)),
          next_(tree.points.size(), [&](const auto& put) {
              for (const Branch& branch : tree.branches)
                  for (std::size_t i = 1; i < branch.points.size(); ++i)
                      put(branch.points[i], branch.points[i - 1]), put(branch.points[i - 1], branch.points[i]);
          }) {
        for (const Point& point : tree.points) before_.push_back({to_voxels_ * point.position, point.radius});
        points_ = before_;
    }

    void pass() {
        std::vector<VoxelPoint> after(points_.size());
        tbb::parallel_for(tbb::blocked_range<std::uint32_t>(0, static_cast<std::uint32_t>(after.size()), 1024),
                          [&](const auto& range) {
                              for (std::uint32_t p = range.begin(); p < range.end(); ++p)
                                  after[p] = within_limits(p, moved(p));
                          });
        points_ = std::move(after);
    }

    void write(VesselTree& tree) const {
        for (std::size_t p = 0; p < points_.size(); ++p)
            if (next_.of(static_cast<std::uint32_t>(p)).size() > 1)
                tree.points[p].position += to_mm_ * (points_[p].at - before_[p].at),
                    tree.points[p].radius = points_[p].radius;
    }

private:
    // One neighbour along the centerline.
    struct Beside {
        VoxelPoint point;
        double away = 1.0; // steps along the centerline, 1 at least
    };
    // The next point, or the place a voxel away if that is farther. The centerline ends at nodes.
    [[nodiscard]] Beside beside(std::uint32_t from, std::uint32_t first) const {
        std::uint32_t before = from, here = first;
        double gone = steps_between(points_[from], points_[first]);
        if (gone >= 1.0) return {points_[first], gone};
        for (int step = 0; step < kMostSteps && next_.of(here).size() == 2; ++step) {
            const auto beyond = next_.of(here);
            const std::uint32_t next = beyond[0] == before ? beyond[1] : beyond[0];
            if (next == from) break; // around a loop
            const double length = steps_between(points_[here], points_[next]);
            if (gone + length >= 1.0) {
                const double share = (1.0 - gone) / length;
                return {{glm::mix(points_[here].at, points_[next].at, share),
                         std::lerp(points_[here].radius, points_[next].radius, share)},
                        1.0};
            }
            gone += length;
            before = here, here = next;
        }
        return {points_[here], 1.0};
    }

    // h^2 / 4 times the second derivative, in voxels: h is 1.
    [[nodiscard]] VoxelPoint moved(std::uint32_t p) const {
        const auto next = next_.of(p);
        VoxelPoint point = points_[p];
        if (next.size() < 2) return point;
        glm::dvec3 slopes(0.0);
        double radius_slopes = 0.0, lengths = 0.0;
        for (const std::uint32_t k : next) {
            const Beside there = beside(p, k);
            const double weight = next.size() == 2 ? 1.0 : there.point.radius;
            lengths += weight * there.away;
            slopes += weight / there.away * (there.point.at - point.at);
            radius_slopes += weight / there.away * (there.point.radius - point.radius);
        }
        point.at += 0.5 / lengths * slopes;
        point.radius += 0.5 / lengths * radius_slopes;
        return point;
    }

    [[nodiscard]] VoxelPoint within_limits(std::uint32_t p, VoxelPoint point) const {
        const VoxelPoint& before = before_[p];
        const glm::dvec3 way = point.at - before.at;
        const double voxels = glm::length(way), mm = glm::length(to_mm_ * way);
        const double share =
            std::min({1.0, kMostVoxels / std::max(voxels, 1e-300), kMostRadii * before.radius / std::max(mm, 1e-300)});
        if (share < 1.0) point.at = before.at + share * way;
        const double most = std::min(kMostVoxels * most_mm_, kMostRadii * before.radius);
        point.radius = std::clamp(point.radius, before.radius - most, before.radius + most);
        return point;
    }

    glm::dmat3 to_voxels_, to_mm_;
    double most_mm_;
    Grouped<std::uint32_t> next_; // points, of each point
    std::vector<VoxelPoint> before_, points_;
};

double median(std::vector<double>& values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::ranges::nth_element(values, middle);
    return *middle;
}

} // namespace

VesselTree smooth(VesselTree tree, int passes) {
    if (passes <= 0 || !tree.voxels) return tree;
    Diffusion diffusion(tree, *tree.voxels);
    for (int pass = 0; pass < passes; ++pass) diffusion.pass();
    diffusion.write(tree);
    return tree;
}

Displacement displacement_of(const VesselTree& before, const VesselTree& after) {
    std::vector<bool> used(before.points.size(), false);
    for (const Branch& branch : before.branches)
        for (const std::uint32_t p : branch.points) used[p] = true;
    Displacement found;
    std::vector<double> mm, radii;
    for (std::size_t p = 0; p < used.size(); ++p) {
        if (!used[p]) continue;
        mm.push_back(glm::distance(before.points[p].position, after.points[p].position));
        radii.push_back(mm.back() / before.points[p].radius);
        if (mm.back() > found.largest_mm) found.largest_mm = mm.back(), found.at = before.points[p].position;
        found.largest_radii = std::max(found.largest_radii, radii.back());
    }
    if (mm.empty()) return found;
    found.median_mm = median(mm), found.median_radii = median(radii);
    return found;
}

} // namespace ramus::tree
