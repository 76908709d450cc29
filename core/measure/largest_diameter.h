// The largest diameter of points: the greatest distance between two of them, exact up to rounding.
//
// Method: pairs of nodes of a bounding-volume hierarchy, the ones farthest apart first; those that cannot be farther
// apart than the best pair of points are left out. About linear in the number of points, for surfaces of bodies.
#pragma once

#include <glm/vec3.hpp>
#include <span>

namespace ramus::measure {

// 0: fewer than two points.
[[nodiscard]] double largest_diameter(std::span<const glm::vec3> points);

} // namespace ramus::measure
