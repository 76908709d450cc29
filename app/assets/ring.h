// The circle that pictures draw around a vessel: where it is cut, where its diameter was measured.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

namespace ramus::app {

// A closed polyline, mm, RAS. `axis`: of unit length.
[[nodiscard]] std::vector<glm::dvec3> ring_around(const glm::dvec3& centre, const glm::dvec3& axis, double radius_mm);

} // namespace ramus::app
