#include "render/scene/bounds.h"

#include "core/base/bounds.h"

#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>

namespace ramus::render {

glm::dvec3 Box::centre() const { return empty() ? glm::dvec3(0.0) : 0.5 * (lower + upper); }

double Box::radius() const {
    const double half_diagonal = empty() ? 0.5 : 0.5 * glm::length(upper - lower);
    return half_diagonal > 0.0 ? half_diagonal : 0.5;
}

void Box::include(const glm::dvec3& point) {
    if (empty()) {
        lower = upper = point;
    } else {
        lower = glm::min(lower, point);
        upper = glm::max(upper, point);
    }
}

Box bounds_of(const mesh::TriangleMesh& mesh) {
    if (mesh.positions.empty()) return {};
    const Bounds<glm::vec3> box = box_of_points(mesh.positions);
    return {glm::dvec3(box.least), glm::dvec3(box.most)};
}

Box bounds_of(const tree::VesselTree& tree) {
    Box box;
    for (const tree::Point& point : tree.points) box.include(point.position);
    return box;
}

Box bounds_of(const Centerlines& lines) {
    if (lines.points.empty()) return {};
    Bounds<glm::vec3> box;
    for (std::size_t i = 0; i < lines.points.size(); ++i)
        box.hold(glm::vec3(lines.points[i]), 0.5F * lines.details[i].diameter_mm);
    return {lines.origin + glm::dvec3(box.least), lines.origin + glm::dvec3(box.most)};
}

// Outside: all corners are beyond one plane of the clip volume.
bool in_picture(const glm::vec3& lower, const glm::vec3& upper, const glm::dmat4& to_clip) {
    std::array<int, 4> beyond{};
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec4 p = to_clip * glm::dvec4(corner & 1 ? upper.x : lower.x, corner & 2 ? upper.y : lower.y,
                                                  corner & 4 ? upper.z : lower.z, 1.0);
        beyond[0] += p.x < -p.w ? 1 : 0;
        beyond[1] += p.x > p.w ? 1 : 0;
        beyond[2] += p.y < -p.w ? 1 : 0;
        beyond[3] += p.y > p.w ? 1 : 0;
    }
    return std::ranges::none_of(beyond, [](int count) { return count == 8; });
}

} // namespace ramus::render
