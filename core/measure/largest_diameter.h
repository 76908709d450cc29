// The largest diameter of points: the greatest distance between two of them. Never too long, and short by less than
// 0.1 %; as a rule exact.
//
// Method: the two outermost points along each of 4,000 directions. No axis is more than 0.035 rad from the nearest of
// them, so one of these pairs is at least cos 0.035 > 0.999 of the longest. Then the farthest point of either end of
// the best pair, until none is farther.
#pragma once

#include <glm/vec3.hpp>
#include <span>

namespace ramus::measure {

// 0: fewer than two points.
[[nodiscard]] double largest_diameter(std::span<const glm::vec3> points);

} // namespace ramus::measure
