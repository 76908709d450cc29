#include "core/validate/joints.h"

#include "core/field/convolution_field.h"
#include "core/tree/prepare.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <limits>
#include <memory>
#include <numbers>
#include <vector>

namespace ramus::validate {

namespace {

constexpr double kVesselLength = 40.0;  // radii; longer than the support of any kernel
constexpr double kFarthest = 12.0;      // radii; upper bound of the distance of a surface from the axes
constexpr double kLookStep = 0.05;      // radii; the step of searches along a line
constexpr double kDaughterAngle = 30.0; // degrees, between a daughter of the fork and the stem's direction

// Vessels of radius 1 that begin at the origin.
class Vessels {
public:
    Vessels(const field::Kernel& kernel, const std::vector<glm::dvec3>& ends)
        : field_(skeleton(ends, kernel.support_radii), kernel), brick_(field_.in_brick()) {
        for (std::uint32_t n = 0; n < ends.size(); ++n) {
            all_.push_back(n);
            directions_.push_back(glm::normalize(ends[n]));
        }
    }

    [[nodiscard]] const glm::dvec3& direction(std::size_t vessel) const { return directions_[vessel]; }
    [[nodiscard]] bool inside(const glm::dvec3& p) const {
        field::GridAxes grid;
        field::LatticeAxes lattice;
        for (std::size_t n = 0; n < field::kGridSide; ++n)
            grid.x[n] = p.x + 0.1 * double(n), grid.y[n] = p.y + 0.1 * double(n), grid.z[n] = p.z + 0.1 * double(n);
        lattice.x.fill(p.x), lattice.y.fill(p.y), lattice.z.fill(p.z);
        brick_->enter(all_, grid);
        const std::array<field::LatticePoint, 1> here{{{0, 0, 0}}};
        std::array<float, 1> value{};
        brick_->sample_lattice(lattice, here, value);
        return value[0] >= field_.isovalue();
    }
    // The distance from an inner point to the surface in a direction.
    [[nodiscard]] double way_out(const glm::dvec3& from, const glm::dvec3& direction) const {
        double low = 0.0;
        while (low < kFarthest && inside(from + (low + kLookStep) * direction)) low += kLookStep;
        double high = low + kLookStep;
        for (int n = 0; n < 20; ++n) {
            const double middle = 0.5 * (low + high);
            (inside(from + middle * direction) ? low : high) = middle;
        }
        return low;
    }
    // The vessel whose axis is nearest to a point, and its distance.
    struct Nearest {
        std::size_t vessel = 0;
        double distance = std::numeric_limits<double>::max();
    };
    [[nodiscard]] Nearest nearest(const glm::dvec3& p) const {
        Nearest nearest;
        for (std::size_t n = 0; n < directions_.size(); ++n) {
            const double along = std::max(glm::dot(p, directions_[n]), 0.0);
            const double distance = glm::distance(p, along * directions_[n]);
            if (distance < nearest.distance) nearest = {n, distance};
        }
        return nearest;
    }

private:
    static field::Skeleton skeleton(const std::vector<glm::dvec3>& ends, double support_radii) {
        tree::PreparedTree prepared;
        prepared.tree.points.push_back({glm::dvec3(0.0), 1.0});
        for (std::uint32_t n = 0; n < ends.size(); ++n) {
            prepared.tree.points.push_back({ends[n], 1.0});
            tree::Branch branch;
            branch.points = {0, n + 1};
            prepared.tree.branches.push_back(branch);
            prepared.segment_source.push_back(static_cast<int>(n));
        }
        return {prepared, support_radii};
    }

    field::ConvolutionField field_;
    std::unique_ptr<field::BrickField> brick_;
    std::vector<std::uint32_t> all_;
    std::vector<glm::dvec3> directions_;
};

struct Thickness {
    double most = 0.0;  // the largest distance of the surface beyond the tubes, in radii
    double reach = 0.0; // how far from the joint the surface is thicker than the tube, along the vessel
};

// Measures the surface around one vessel, up to a distance from the joint. All vessels lie in the plane z = 0.
Thickness thickness_around(const Vessels& vessels, std::size_t vessel, double upto) {
    constexpr int kAround = 12; // over half of the circle; the other half is symmetric
    constexpr double kAlong = 0.1, kThicker = 0.01;
    Thickness found;
    const glm::dvec3 along = vessels.direction(vessel), up(0.0, 0.0, 1.0), aside = glm::cross(up, along);
    for (double t = 0.0; t <= upto; t += kAlong)
        for (int n = 0; n <= kAround; ++n) {
            const double angle = (double(n) / kAround - 0.5) * std::numbers::pi;
            for (const double side : {-1.0, 1.0}) {
                const glm::dvec3 way = side * std::cos(angle) * aside + std::sin(angle) * up;
                const glm::dvec3 at = t * along + vessels.way_out(t * along, way) * way;
                const Vessels::Nearest nearest = vessels.nearest(at);
                const double thicker = nearest.distance - 1.0;
                found.most = std::max(found.most, thicker);
                if (nearest.vessel == vessel && thicker > kThicker)
                    found.reach = std::max(found.reach, glm::dot(at, along));
            }
        }
    return found;
}

} // namespace

JointFigures joint_figures(const field::Kernel& kernel) {
    JointFigures found;
    found.merging = kernel.limits.merged;
    const double angle = glm::radians(kDaughterAngle);
    const Vessels fork(kernel, {{-kVesselLength, 0.0, 0.0},
                                {kVesselLength * std::cos(angle), kVesselLength * std::sin(angle), 0.0},
                                {kVesselLength * std::cos(angle), -kVesselLength * std::sin(angle), 0.0}});
    found.parting = fork.way_out(glm::dvec3(0.0), {1.0, 0.0, 0.0}) * std::sin(angle);
    const Thickness stem = thickness_around(fork, 0, kernel.support_radii);
    const Thickness daughter = thickness_around(fork, 1, kFarthest);
    found.blend_reach = daughter.reach;
    found.bulge_percent = 100.0 * std::max(stem.most, daughter.most);
    const Vessels straight(kernel, {{-kVesselLength, 0.0, 0.0}, {kVesselLength, 0.0, 0.0}});
    for (double x = -3.0; x <= 3.0; x += kLookStep)
        found.straight_percent =
            std::max(found.straight_percent, 100.0 * std::abs(straight.way_out({x, 0.0, 0.0}, {0.0, 0.0, 1.0}) - 1.0));
    const Vessels ending(kernel, {{-kVesselLength, 0.0, 0.0}});
    found.beyond_end = ending.way_out({-4.0, 0.0, 0.0}, {1.0, 0.0, 0.0}) - 4.0;
    return found;
}

} // namespace ramus::validate
