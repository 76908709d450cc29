// How many connected pieces a mesh has: triangles that share a vertex belong together.
#pragma once

#include "core/mesh/triangle_mesh.h"

namespace ramus::measure {

// Vertices that no triangle uses do not count.
[[nodiscard]] int component_count(const mesh::TriangleMesh& mesh);

} // namespace ramus::measure
