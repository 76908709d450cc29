#include "core/slice/plane_shape.h"

#include "core/base/infinity.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace ramus::slice {

namespace {

double crossed(const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; }

double equivalent_diameter(double area) { return 2.0 * std::sqrt(area / std::numbers::pi); }

} // namespace

PlaneAxes::PlaneAxes(const Plane& plane) : origin(plane.point) {
    const Axes axes = axes_across(plane.normal);
    u = axes.right;
    v = glm::cross(plane.normal, u);
}

Outline outline_of(const Loop& loop, const PlaneAxes& axes) {
    Outline outline;
    outline.reserve(loop.points.size());
    for (const EdgePoint& point : loop.points) outline.push_back(axes.on(point.at));
    return outline;
}

double twice_area(const Outline& outline) {
    double twice = 0.0;
    for (std::size_t k = 1; k + 1 < outline.size(); ++k) // about a corner, for the sake of rounding
        twice += crossed(outline[k] - outline.front(), outline[k + 1] - outline.front());
    return twice;
}

bool encloses(const Outline& outline, const glm::dvec2& at) {
    bool inside = false;
    for (std::size_t k = 0, before = outline.size() - 1; k < outline.size(); before = k++) {
        const glm::dvec2& a = outline[before];
        const glm::dvec2& b = outline[k];
        if ((a.y > at.y) != (b.y > at.y) && at.x < a.x + (at.y - a.y) / (b.y - a.y) * (b.x - a.x)) inside = !inside;
    }
    return inside;
}

Outline convex_hull(Outline points) {
    // Andrew's monotone chain.
    std::ranges::sort(points, {}, [](const glm::dvec2& p) { return std::pair(p.x, p.y); });
    points.erase(std::unique(points.begin(), points.end()), points.end());
    if (points.size() < 3) return points;
    Outline hull;
    const auto take = [&](const glm::dvec2& point, std::size_t least) {
        while (hull.size() >= least + 2 && crossed(hull.back() - hull[hull.size() - 2], point - hull.back()) <= 0.0)
            hull.pop_back();
        hull.push_back(point);
    };
    for (const glm::dvec2& point : points) take(point, 0);
    const std::size_t lower = hull.size() - 1;
    for (std::size_t n = points.size() - 1; n-- > 0;) take(points[n], lower);
    hull.pop_back();
    return hull;
}

Calipers calipers_of(const Outline& hull) {
    if (hull.size() < 2) return {};
    if (hull.size() == 2) return {0.0, glm::distance(hull[0], hull[1])};
    Calipers calipers{kInfinity, 0.0};
    const auto [left, right] = std::ranges::minmax(hull, {}, &glm::dvec2::x);
    const auto [low, high] = std::ranges::minmax(hull, {}, &glm::dvec2::y);
    // Points that nearly coincide, or lie on a straight line up to rounding, must not stop the calipers.
    const double rounding = 1e-9 * (right.x - left.x + high.y - low.y);
    std::size_t far = 1;
    for (std::size_t k = 0; k < hull.size(); ++k) {
        const std::size_t next = (k + 1) % hull.size();
        const double length = glm::distance(hull[k], hull[next]);
        if (!(length > rounding)) continue;
        const glm::dvec2 edge = (hull[next] - hull[k]) / length;
        const auto height = [&](std::size_t n) { return crossed(edge, hull[n] - hull[k]); };
        double most = 0.0;
        for (std::size_t steps = 0; steps < hull.size(); ++steps, far = (far + 1) % hull.size()) {
            most = std::max(most, height(far));
            calipers.largest =
                std::max({calipers.largest, glm::distance(hull[k], hull[far]), glm::distance(hull[next], hull[far])});
            if (height((far + 1) % hull.size()) < height(far) - rounding) break;
        }
        calipers.least = std::min(calipers.least, most);
    }
    if (calipers.least == kInfinity) calipers.least = 0.0;
    return calipers;
}

ShapeFigures figures_of_disc(double diameter_mm) {
    return {0.25 * std::numbers::pi * diameter_mm * diameter_mm, diameter_mm, diameter_mm, diameter_mm, {}};
}

ShapeFigures figures_of(std::span<const Loop> loops, const Plane& plane) {
    const PlaneAxes axes(plane);
    double twice = 0.0;
    glm::dvec2 moment(0.0);
    Outline all;
    for (const Loop& loop : loops) {
        const Outline outline = outline_of(loop, axes);
        if (outline.size() < 3) continue;
        all.insert(all.end(), outline.begin(), outline.end());
        const glm::dvec2& about = outline.front();
        for (std::size_t k = 1; k + 1 < outline.size(); ++k) {
            const double part = crossed(outline[k] - about, outline[k + 1] - about);
            twice += part;
            moment += part / 3.0 * (about + outline[k] + outline[k + 1]);
        }
    }
    if (!(twice > 0.0)) return {};
    const Calipers calipers = calipers_of(convex_hull(std::move(all)));
    return {0.5 * twice, equivalent_diameter(0.5 * twice), calipers.least, calipers.largest,
            axes.place(moment / twice)};
}

} // namespace ramus::slice
