// Whether a line meets a triangle, in double precision.
#pragma once

#include <array>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace ramus::mesh {

// Six times that of a tetrahedron; its sign tells on which side of a b c, counter-clockwise, d is.
[[nodiscard]] inline double signed_volume(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c,
                                          const glm::dvec3& d) {
    return glm::dot(glm::cross(b - a, c - a), d - a);
}

// Where it is known that the line's ends are on different sides of the triangle's plane.
[[nodiscard]] inline bool passes_within(const glm::dvec3& p, const glm::dvec3& q, const std::array<glm::dvec3, 3>& t) {
    const double a = signed_volume(p, q, t[0], t[1]), b = signed_volume(p, q, t[1], t[2]),
                 c = signed_volume(p, q, t[2], t[0]);
    return (a >= 0.0 && b >= 0.0 && c >= 0.0) || (a <= 0.0 && b <= 0.0 && c <= 0.0);
}

// The line ends at p and q. One that lies in the triangle's plane does not meet it.
[[nodiscard]] inline bool line_meets(const glm::dvec3& p, const glm::dvec3& q, const std::array<glm::dvec3, 3>& t) {
    if ((signed_volume(t[0], t[1], t[2], p) > 0.0) == (signed_volume(t[0], t[1], t[2], q) > 0.0)) return false;
    return passes_within(p, q, t);
}

} // namespace ramus::mesh
