// Fans: the surfaces of several vessels in one cell, each from a vertex in the cell to a closed line on its boundary.
#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <span>
#include <utility>
#include <vector>

namespace ramus::mesh::bricks {

struct Fan {
    std::vector<std::pair<glm::vec3, glm::vec3>> edges; // of the closed line
};

// Whether two lines of three points each meet, in the plane across an axis.
[[nodiscard]] bool lines_meet(const std::array<glm::vec3, 3>& a, const std::array<glm::vec3, 3>& b, int axis);

// Whether two fans from these vertices meet.
[[nodiscard]] bool fans_meet(const Fan& a, const glm::vec3& from_a, const Fan& b, const glm::vec3& from_b);

// Moves vertices so that no fans meet, as far as it can. `toward`: from the cell's walls into each vessel; 0 where a
// vessel has no wall. Vertices stay in the box. Returns whether none meet.
bool part_fans(std::span<const Fan> fans, std::span<const glm::vec3> toward, const glm::vec3& lower,
               const glm::vec3& upper, std::span<glm::vec3> vertices);

} // namespace ramus::mesh::bricks
