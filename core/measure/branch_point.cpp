#include "core/measure/branch_point.h"

#include "core/base/lines.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

namespace ramus::measure {

BranchPoint point_on(const tree::VesselTree& tree, int branch, double fraction) {
    const auto& points = tree.branches[static_cast<std::size_t>(branch)].points;
    const double wanted =
        std::clamp(fraction, 0.0, 1.0) * tree::length_mm(tree, tree.branches[static_cast<std::size_t>(branch)]);
    double before = 0.0;
    for (std::size_t i = 1; i < points.size(); ++i) {
        const tree::Point& a = tree.points[points[i - 1]];
        const tree::Point& b = tree.points[points[i]];
        const double length = glm::distance(a.position, b.position);
        const bool last = i + 1 == points.size();
        if (last || before + length >= wanted) {
            const double t = length > 0.0 ? std::clamp((wanted - before) / length, 0.0, 1.0) : 1.0;
            const glm::dvec3 along = b.position - a.position;
            return {a.position + t * along, length > 0.0 ? along / length : glm::dvec3(0.0, 0.0, 1.0),
                    a.radius + t * (b.radius - a.radius)};
        }
        before += length;
    }
    return {};
}

double nearest_fraction(const tree::VesselTree& tree, int branch, const glm::dvec3& point) {
    const auto& points = tree.branches[static_cast<std::size_t>(branch)].points;
    double length = 0.0;
    double at = 0.0;
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 1; i < points.size(); ++i) {
        const glm::dvec3& a = tree.points[points[i - 1]].position;
        const glm::dvec3 along = tree.points[points[i]].position - a;
        const double t = share_along(point - a, along), step = glm::length(along);
        const double distance = glm::distance(point, a + t * along);
        if (distance < nearest) nearest = distance, at = length + t * step;
        length += step;
    }
    return length > 0.0 ? at / length : 0.0;
}

BranchPart part_of(const tree::VesselTree& tree, int branch, double from, double to) {
    const tree::Branch& whole = tree.branches[static_cast<std::size_t>(branch)];
    const double length = tree::length_mm(tree, whole);
    const double least = std::clamp(from, 0.0, 1.0) * length;
    const double most = std::clamp(to, 0.0, 1.0) * length;
    BranchPart part;
    double before = 0.0;
    for (std::size_t i = 1; i < whole.points.size() && before < most; ++i) {
        const tree::Point& a = tree.points[whole.points[i - 1]];
        const tree::Point& b = tree.points[whole.points[i]];
        const double step = glm::distance(a.position, b.position);
        const double start = std::max(least - before, 0.0);
        const double end = std::min(most - before, step);
        if (end > start && step > 0.0) {
            const double r0 = a.radius + start / step * (b.radius - a.radius);
            const double r1 = a.radius + end / step * (b.radius - a.radius);
            part.length_mm += end - start;
            part.volume_mm3 += std::numbers::pi / 3.0 * (end - start) * (r0 * r0 + r0 * r1 + r1 * r1);
        }
        before += step;
    }
    return part;
}

} // namespace ramus::measure
