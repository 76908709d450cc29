// Two unit vectors at right angles to a direction and to each other.
#pragma once

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace ramus {

// `direction` of unit length. The second vector is the cross product of the direction and the first one.
[[nodiscard]] inline std::array<glm::dvec3, 2> axes_across(const glm::dvec3& direction) {
    const glm::dvec3 aside = std::abs(direction.x) < 0.7 ? glm::dvec3(1.0, 0.0, 0.0) : glm::dvec3(0.0, 1.0, 0.0);
    const glm::dvec3 first = glm::normalize(glm::cross(direction, aside));
    return {first, glm::cross(direction, first)};
}

} // namespace ramus
