#include "core/slice/path_curve.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace ramus::slice {

namespace {

// The centerline as the file has it, with its arc length.
struct FileLine {
    std::vector<glm::dvec3> points;
    std::vector<double> radii, arcs;

    void add(const glm::dvec3& at, double radius) {
        const double step = points.empty() ? 0.0 : glm::distance(points.back(), at);
        if (!points.empty() && step == 0.0) return;
        arcs.push_back(arcs.empty() ? 0.0 : arcs.back() + step);
        points.push_back(at);
        radii.push_back(radius);
    }
};

void add_part(const tree::VesselTree& tree, const PathPart& part, FileLine& line) {
    const auto& points = tree.branches[static_cast<std::size_t>(part.branch)].points;
    const double length = tree::length_mm(tree, tree.branches[static_cast<std::size_t>(part.branch)]);
    const double least = std::min(part.from, part.to) * length, most = std::max(part.from, part.to) * length;
    std::vector<std::uint32_t> inner;
    double before = 0.0;
    for (std::size_t i = 1; i + 1 < points.size(); ++i) {
        before += glm::distance(tree.points[points[i - 1]].position, tree.points[points[i]].position);
        if (before > least && before < most) inner.push_back(points[i]);
    }
    if (part.from > part.to) std::ranges::reverse(inner);
    const auto add_end = [&](double fraction) {
        const measure::BranchPoint end = measure::point_on(tree, part.branch, fraction);
        line.add(end.position, end.radius_mm);
    };
    add_end(part.from);
    for (const std::uint32_t point : inner) line.add(tree.points[point].position, tree.points[point].radius);
    add_end(part.to);
}

constexpr double kReach = 3.0;   // standard deviations
constexpr double kMostTaps = 64; // to each side: enough for any Gaussian, however small the steps are

// Calls `call(offset, weight)` for offsets above 0.
template <class Call> void for_taps(double sigma, const Call& call) {
    const double stride = std::max(1.0, kReach * sigma / kMostTaps);
    for (double offset = stride; offset <= kReach * sigma; offset += stride)
        call(offset, std::exp(-0.5 * (offset / sigma) * (offset / sigma)));
}

} // namespace

PathCurve curve_along(const tree::VesselTree& tree, std::span<PathPart> parts, double step_mm) {
    FileLine line;
    for (PathPart& part : parts) {
        part.begin_mm = line.arcs.empty() ? 0.0 : line.arcs.back();
        add_part(tree, part, line);
        part.end_mm = line.arcs.back();
    }
    const double length = line.arcs.back();
    const auto steps = static_cast<std::size_t>(std::max(1.0, std::ceil(length / step_mm)));
    PathCurve curve{{}, {}, length / static_cast<double>(steps)};
    std::size_t segment = 1;
    for (std::size_t n = 0; n <= steps; ++n) {
        const double arc = n == steps ? length : curve.step_mm * static_cast<double>(n);
        while (segment + 1 < line.arcs.size() && line.arcs[segment] < arc) ++segment;
        const double share =
            std::clamp((arc - line.arcs[segment - 1]) / (line.arcs[segment] - line.arcs[segment - 1]), 0.0, 1.0);
        curve.points.push_back(line.points[segment - 1] + share * (line.points[segment] - line.points[segment - 1]));
        curve.radii.push_back(line.radii[segment - 1] + share * (line.radii[segment] - line.radii[segment - 1]));
    }
    return curve;
}

glm::dvec3 CurveFilter::point(double at) const {
    const auto last = static_cast<double>(points_.size() - 1);
    if (at < 0.0) return 2.0 * points_.front() - point(std::min(-at, last));
    if (at > last) return 2.0 * points_.back() - point(std::max(2.0 * last - at, 0.0));
    const auto low = std::min(static_cast<std::size_t>(at), points_.size() - 2);
    const double share = at - static_cast<double>(low);
    return (1.0 - share) * points_[low] + share * points_[low + 1];
}

glm::dvec3 CurveFilter::mean(double at, double sigma) const {
    glm::dvec3 sum = point(at);
    double weights = 1.0;
    for_taps(sigma, [&](double offset, double weight) {
        sum += weight * (point(at - offset) + point(at + offset));
        weights += 2.0 * weight;
    });
    return sum / weights;
}

glm::dvec3 CurveFilter::direction(double at, double sigma) const {
    // The derivative of the filtered curve, by parts: the Gaussian's derivative times the curve.
    glm::dvec3 sum(0.0);
    for_taps(sigma,
             [&](double offset, double weight) { sum += offset * weight * (point(at + offset) - point(at - offset)); });
    return sum;
}

} // namespace ramus::slice
