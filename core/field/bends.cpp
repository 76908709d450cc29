#include "core/field/bends.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <optional>
#include <utility>
#include <vector>

namespace ramus::field {

namespace {

constexpr double kChord = 0.75; // radii

// A branch's points as a way.
class BendingWay {
public:
    BendingWay(const tree::VesselTree& tree, const tree::Branch& branch) : tree_(tree), points_(branch.points) {}

    // Of a point, in 1 / radius; 0 beside a segment longer than a radius, and nearer than a chord to the branch's ends.
    [[nodiscard]] double curvature(std::size_t i) const {
        const double radius = tree_.points[points_[i]].radius, chord = kChord * radius;
        if (std::max(length(i - 1), length(i)) > radius) return 0.0;
        const auto behind = place_behind(i, chord), before = place_before(i, chord);
        if (!behind || !before) return 0.0;
        return glm::length(*behind + *before - 2.0 * position(i)) / (chord * chord) * radius;
    }

private:
    [[nodiscard]] const glm::dvec3& position(std::size_t i) const { return tree_.points[points_[i]].position; }
    [[nodiscard]] double length(std::size_t segment) const {
        return glm::distance(position(segment), position(segment + 1));
    }
    // The place so many mm behind a point, or before it, where the branch is that long.
    [[nodiscard]] std::optional<glm::dvec3> place_behind(std::size_t i, double left) const {
        for (; i + 1 < points_.size(); left -= length(i), ++i)
            if (length(i) > left) return glm::mix(position(i), position(i + 1), left / length(i));
        return std::nullopt;
    }
    [[nodiscard]] std::optional<glm::dvec3> place_before(std::size_t i, double left) const {
        for (; i > 0; left -= length(i - 1), --i)
            if (length(i - 1) > left) return glm::mix(position(i), position(i - 1), left / length(i - 1));
        return std::nullopt;
    }

    const tree::VesselTree& tree_;
    const std::vector<std::uint32_t>& points_;
};

// Of the logarithm of a long vessel's field, by the squared distance in radii, at its surface.
double fall_at_surface(const Kernel& kernel) {
    constexpr double kStep = 0.01;
    const auto log_at = [&](double radii2) { return std::log(kernel.long_vessel->value(kernel, radii2)); };
    return (log_at(1.0 - kStep) - log_at(1.0 + kStep)) / (2.0 * kStep);
}

} // namespace

tree::PreparedTree thinner_in_bends(tree::PreparedTree prepared, const Kernel& kernel) {
    std::vector<double> radii(prepared.tree.points.size());
    for (std::uint32_t p = 0; p < radii.size(); ++p) radii[p] = prepared.kernel_radius(p);
    const double part = 1.0 / (16.0 * fall_at_surface(kernel));
    for (const tree::Branch& branch : prepared.tree.branches) {
        const BendingWay way(prepared.tree, branch);
        for (std::size_t i = 1; i + 1 < branch.points.size(); ++i) {
            const double curvature = way.curvature(i);
            radii[branch.points[i]] *= std::max(1.0 - part * curvature * curvature, kThinnestInBends);
        }
    }
    prepared.kernel_radii = std::move(radii);
    return prepared;
}

} // namespace ramus::field
