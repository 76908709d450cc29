// Triangular holes in triangles of a surface, and tubes between two of them.
#pragma once

#include "core/mesh/triangle_mesh.h"

#include <cstddef>
#include <glm/vec3.hpp>

namespace ramus::mesh {

// Puts six triangles in the place of one, around a hole in it; five of them come last. `hole`: its corners, the same
// way round, each next to the corner of the triangle with the same place.
void open_hole(TriangleMesh& mesh, std::size_t triangle, const glm::uvec3& hole);
// Adds a tube of six triangles from one hole to another. `across`: for each corner of the first hole the one of the
// second hole that it is joined to.
void connect_holes(TriangleMesh& mesh, const glm::uvec3& hole, const glm::uvec3& across);

} // namespace ramus::mesh
