// Triangles that span a closed line in space.
#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace ramus::mesh {

// Those of least area in all, between the corners of the line alone (Barequet and Sharir, Filling gaps in the boundary
// of a polyhedron, 1995). Each turns with the line: its corners ascend. Takes time as the cube of the corners' number.
[[nodiscard]] std::vector<glm::uvec3> spanning_triangles(std::span<const glm::dvec3> line);

} // namespace ramus::mesh
