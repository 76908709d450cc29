// Cuts quads along the better of their two diagonals. Vectorised over the quads.
#pragma once

#include "core/mesh/triangle_mesh.h"

#include <glm/vec4.hpp>
#include <span>

namespace ramus::mesh::bricks {

// Writes two triangles for each quad (vertices of `mesh`, counter-clockwise) to `triangles`.
void cut_quads(const TriangleMesh& mesh, std::span<const glm::uvec4> quads, std::span<glm::uvec3> triangles);

} // namespace ramus::mesh::bricks
