// Cuts quads along the better of their two diagonals. Vectorised over the quads.
#pragma once

#include "core/mesh/triangle_mesh.h"

#include <glm/vec4.hpp>
#include <span>

namespace ramus::mesh::bricks {

// Writes two triangles for each quad (of `vertices`, counter-clockwise) to `triangles`.
void cut_quads(const VertexSpan& vertices, std::span<const glm::uvec4> quads, std::span<glm::uvec3> triangles);

} // namespace ramus::mesh::bricks
