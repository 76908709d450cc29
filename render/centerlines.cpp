#include "render/centerlines.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace ramus::render {

std::optional<Centerlines::Place> Centerlines::at(int branch, double fraction) const {
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
    Place place;
    place.position = origin + glm::dvec3(glm::mix(a, b, t));
    const glm::dvec3 away = glm::dvec3(b) - glm::dvec3(a);
    if (glm::dot(away, away) > 0.0) place.along = glm::normalize(away);
    place.from_root_mm = wanted;
    place.radius_mm = 0.5 * glm::mix(double(details[i].diameter_mm), double(details[i + 1].diameter_mm), t);
    return place;
}

} // namespace ramus::render
