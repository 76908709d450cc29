// Triangulates a closed line in space.
#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace ramus::mesh {

// The triangulation of least total area, without new vertices (Barequet and Sharir, Filling gaps in the boundary of a
// polyhedron, 1995). The corners of each triangle are ascending indices into `line`. Takes cubic time in the number of
// corners.
[[nodiscard]] std::vector<glm::uvec3> spanning_triangles(std::span<const glm::dvec3> line);

} // namespace ramus::mesh
