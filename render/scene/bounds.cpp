#include "render/scene/bounds.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

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
    glm::vec3 lower = mesh.positions.front(), upper = lower;
    for (const glm::vec3& position : mesh.positions) {
        lower = glm::min(lower, position);
        upper = glm::max(upper, position);
    }
    return {glm::dvec3(lower), glm::dvec3(upper)};
}

Box bounds_of(const Centerlines& lines) {
    if (lines.points.empty()) return {};
    glm::vec3 lower(lines.points.front()), upper = lower;
    for (std::size_t i = 0; i < lines.points.size(); ++i) {
        const float radius = 0.5F * lines.details[i].diameter_mm;
        lower = glm::min(lower, glm::vec3(lines.points[i]) - radius);
        upper = glm::max(upper, glm::vec3(lines.points[i]) + radius);
    }
    return {lines.origin + glm::dvec3(lower), lines.origin + glm::dvec3(upper)};
}

} // namespace ramus::render
