// Intersection test of a line segment and a triangle, in double precision (not exact).
#pragma once

#include <array>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace ramus::mesh {

// Six times the signed volume of a tetrahedron. The sign is the side of the plane of a, b, c on which d lies.
[[nodiscard]] inline double signed_volume(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c,
                                          const glm::dvec3& d) {
    return glm::dot(glm::cross(b - a, c - a), d - a);
}

// Whether the segment from p to q passes through the triangle. p and q must be on different sides of its plane.
[[nodiscard]] inline bool passes_within(const glm::dvec3& p, const glm::dvec3& q, const std::array<glm::dvec3, 3>& t) {
    const double a = signed_volume(p, q, t[0], t[1]), b = signed_volume(p, q, t[1], t[2]),
                 c = signed_volume(p, q, t[2], t[0]);
    return (a >= 0.0 && b >= 0.0 && c >= 0.0) || (a <= 0.0 && b <= 0.0 && c <= 0.0);
}

// Whether the segment from p to q intersects the triangle. A segment in the plane of the triangle does not.
[[nodiscard]] inline bool line_meets(const glm::dvec3& p, const glm::dvec3& q, const std::array<glm::dvec3, 3>& t) {
    if ((signed_volume(t[0], t[1], t[2], p) > 0.0) == (signed_volume(t[0], t[1], t[2], q) > 0.0)) return false;
    return passes_within(p, q, t);
}

} // namespace ramus::mesh
