// Opens triangular holes in triangles of a surface, and connects two holes by a tube.
#pragma once

#include "core/mesh/triangle_mesh.h"

#include <cstddef>
#include <glm/vec3.hpp>

namespace ramus::mesh {

// Replaces a triangle by six triangles around a hole; five of them are appended. `hole`: the vertices of the hole, with
// the orientation of the triangle, each next to the corner of the triangle with the same index.
void open_hole(TriangleMesh& mesh, std::size_t triangle, const glm::uvec3& hole);
// Adds a tube of six triangles between two holes. `across`: for each corner of the first hole, the corner of the second
// hole to which it is connected.
void connect_holes(TriangleMesh& mesh, const glm::uvec3& hole, const glm::uvec3& across);

} // namespace ramus::mesh
