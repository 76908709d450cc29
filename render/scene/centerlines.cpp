#include "render/scene/centerlines.h"

#include "core/base/bounds.h"
#include "core/base/lines.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace ramus::render {

std::optional<Centerlines::BranchPoint> Centerlines::at(int branch, double fraction) const {
    if (branch < 0 || static_cast<std::size_t>(branch) >= runs.size()) return {};
    const Run run = runs[static_cast<std::size_t>(branch)];
    if (run.count < 2) return {};
    const auto end = run.first + run.count - 1;
    const double wanted = glm::mix(double(points[run.first].w), double(points[end].w), std::clamp(fraction, 0.0, 1.0));
    std::size_t i = run.first;
    while (i + 2 <= end && points[i + 1].w < wanted) ++i;
    const glm::dvec4 a = points[i], b = points[i + 1];
    const double step = b.w - a.w;
    const double t = step > 0.0 ? std::clamp((wanted - a.w) / step, 0.0, 1.0) : 0.0;
    BranchPoint point;
    point.position = origin + glm::dvec3(glm::mix(a, b, t));
    const glm::dvec3 away = glm::dvec3(b) - glm::dvec3(a);
    if (glm::dot(away, away) > 0.0) point.along = glm::normalize(away);
    point.from_root_mm = wanted;
    point.radius_mm = 0.5 * glm::mix(double(details[i].diameter_mm), double(details[i + 1].diameter_mm), t);
    return point;
}

double Centerlines::extent_mm() const {
    if (points.empty()) return 0.0;
    return glm::length(glm::vec3(box_of_points(points).size()));
}

namespace {

struct Most {
    double mm, radii;
};

// The point between `first` and `last` with the largest deviation from their line, relative to the tolerance: more than
// 1 is too far.
std::pair<std::size_t, double> farthest(const Centerlines& lines, std::size_t first, std::size_t last,
                                        const Most& most) {
    const glm::dvec3 a(lines.points[first]), ab = glm::dvec3(lines.points[last]) - a;
    const double ra = 0.5 * lines.details[first].diameter_mm, rb = 0.5 * lines.details[last].diameter_mm;
    std::pair<std::size_t, double> found{first, 0.0};
    for (std::size_t i = first + 1; i < last; ++i) {
        const glm::dvec3 ap = glm::dvec3(lines.points[i]) - a;
        const double t = share_along(ap, ab);
        const double radius = 0.5 * lines.details[i].diameter_mm;
        const double off = glm::length(ap - t * ab) + std::abs(radius - (ra + t * (rb - ra)));
        const double by_radius = std::isinf(most.radii) ? most.mm : most.radii * radius;
        const double share = off / std::max(1e-9, std::min(by_radius, most.mm));
        if (share > found.second) found = {i, share};
    }
    return found;
}

} // namespace

// Douglas and Peucker (1973): keeps the farthest point and continues on both sides.
Centerlines Centerlines::thinned(double most_mm, double most_radii) const {
    Centerlines fewer;
    fewer.origin = origin;
    fewer.runs.resize(runs.size());
    for (std::size_t branch = 0; branch < runs.size(); ++branch) {
        const Run run = runs[branch];
        fewer.runs[branch].first = static_cast<std::uint32_t>(fewer.points.size());
        const auto keep = [&](std::size_t point) {
            fewer.points.push_back(points[point]);
            fewer.details.push_back(details[point]);
        };
        if (run.count > 0) keep(run.first);
        std::vector<std::size_t> ends; // stack of the ends of open intervals
        if (run.count > 1) ends.push_back(run.first + run.count - 1);
        for (std::size_t from = run.first; !ends.empty();) {
            const auto [point, share] = farthest(*this, from, ends.back(), {most_mm, most_radii});
            if (share > 1.0) {
                ends.push_back(point);
                continue;
            }
            from = ends.back();
            ends.pop_back();
            keep(from);
        }
        fewer.runs[branch].count = static_cast<std::uint32_t>(fewer.points.size()) - fewer.runs[branch].first;
    }
    return fewer;
}

} // namespace ramus::render
