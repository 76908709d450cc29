#include "core/organ/resect/resection.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

namespace ramus::organ {

namespace {

double value_of(const HalfSpace& half, const glm::dvec3& p) { return -glm::dot(p - half.point, half.normal); }
double value_of(const Sheet& sheet, const glm::dvec3& p) {
    const double above = height_above(sheet, p);
    return sheet.removes_below ? above : -above;
}
double value_of(const SurfaceCut& cut, const glm::dvec3& p) {
    const double value = cut.surface->value_at(p);
    return cut.other_side ? -value : value;
}
double value_of(const Around& around, const glm::dvec3& p) {
    constexpr double kLeast = 1e-4; // mm; above the rounding of corners, so that a margin of 0 removes the voxels
    return around.solid->distance(p) - std::max(around.margin_mm, kLeast);
}

// Adds the crossings between two fractions of the segment.
struct CrossingSearch {
    const Resection& resection;
    const glm::dvec3 &a, &b;
    double length, steepest;
    std::vector<double>& found;

    void look(double from, double to, double value_from, double value_to) const {
        const bool changes = (value_from > 0.0) != (value_to > 0.0);
        const double span = (to - from) * length;
        // Between two values of one sign the function needs a way of their sum to come to 0 and back.
        if (!changes && std::abs(value_from) + std::abs(value_to) > steepest * span) return;
        constexpr double kFine = 0.01; // mm
        if (span <= kFine) {
            if (!changes) return;
            const glm::dvec3 first = glm::mix(a, b, from), last = glm::mix(a, b, to);
            const double at = zero_between(resection, first, last, value_from, value_to);
            // The side of a point beyond the border of an open mesh may change where no mesh is.
            if (std::abs(value_at(resection, glm::mix(first, last, at))) > steepest * 1e-3) return;
            found.push_back(std::lerp(from, to, at));
            return;
        }
        const double middle = 0.5 * (from + to);
        const double value = value_at(resection, glm::mix(a, b, middle));
        look(from, middle, value_from, value);
        look(middle, to, value, value_to);
    }
};

} // namespace

double value_at(const Resection& resection, const glm::dvec3& point) {
    return std::visit([&](const auto& one) { return value_of(one, point); }, resection);
}

bool removes(const Resection& resection, const glm::dvec3& point) {
    const auto* around = std::get_if<Around>(&resection);
    if (around != nullptr && around->margin_mm == 0.0) return around->solid->contains(point);
    return value_at(resection, point) <= 0.0;
}

double steepest_in(const Resection& resection, const Bounds<glm::dvec3>& box) {
    const auto* sheet = std::get_if<Sheet>(&resection);
    return sheet == nullptr ? 1.0 : steepest_in(*sheet, box);
}

glm::dvec3 normal_at(const Resection& resection, const glm::dvec3& point) {
    if (const auto* half = std::get_if<HalfSpace>(&resection)) return -half->normal;
    constexpr double kStep = 1e-3; // mm
    glm::dvec3 rise(0.0);
    for (int axis = 0; axis < 3; ++axis) {
        glm::dvec3 step(0.0);
        step[axis] = kStep;
        rise[axis] = value_at(resection, point + step) - value_at(resection, point - step);
    }
    const double length = glm::length(rise);
    return length > 0.0 ? rise / length : glm::dvec3(0.0, 0.0, 1.0);
}

std::vector<double> crossings_of(const Resection& resection, const glm::dvec3& a, const glm::dvec3& b,
                                 double steepest) {
    std::vector<double> found;
    const double value_a = value_at(resection, a), value_b = value_at(resection, b);
    if (std::holds_alternative<HalfSpace>(resection)) {
        if ((value_a > 0.0) != (value_b > 0.0)) found.push_back(value_a / (value_a - value_b));
        return found;
    }
    CrossingSearch{resection, a, b, glm::distance(a, b), steepest, found}.look(0.0, 1.0, value_a, value_b);
    return found;
}

double zero_between(const Resection& resection, const glm::dvec3& a, const glm::dvec3& b, double value_a,
                    double value_b) {
    double from = 0.0, to = 1.0;
    if (std::holds_alternative<HalfSpace>(resection)) return value_a / (value_a - value_b);
    // The Illinois method: the secant, with the value of an end halved that has stayed twice.
    constexpr double kNear = 1e-11; // mm
    if (std::abs(value_a) < kNear) return 0.0;
    if (std::abs(value_b) < kNear) return 1.0;
    constexpr int kMostSteps = 60;
    double at = 0.5;
    int stayed = 0;
    for (int n = 0; n < kMostSteps && to - from > 1e-14; ++n) {
        at = value_a == value_b ? 0.5 * (from + to) : from + (to - from) * value_a / (value_a - value_b);
        if (!(at > from && at < to)) at = 0.5 * (from + to);
        const double value = value_at(resection, glm::mix(a, b, at));
        if (std::abs(value) < kNear) break;
        if ((value > 0.0) == (value_a > 0.0)) {
            from = at;
            value_a = value;
            if (stayed == 1) value_b *= 0.5;
            stayed = 1;
        } else {
            to = at;
            value_b = value;
            if (stayed == 2) value_a *= 0.5;
            stayed = 2;
        }
    }
    return at;
}

} // namespace ramus::organ
