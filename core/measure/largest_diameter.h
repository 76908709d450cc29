// The largest diameter of points: the greatest distance between two of them. Never too long, and short by less than
// 0.1 %; as a rule exact.
//
// Method: the two outermost points along each of 2,000 directions, which are nowhere more than 0.045 rad apart, so that
// one is that near to the direction of the longest pair (cos 0.045 > 0.999); then the farthest point of either end of
// the longest of these pairs, until none is farther.
#pragma once

#include <glm/vec3.hpp>
#include <span>

namespace ramus::measure {

// 0: fewer than two points.
[[nodiscard]] double largest_diameter(std::span<const glm::vec3> points);

} // namespace ramus::measure
