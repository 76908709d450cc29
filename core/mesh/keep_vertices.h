// Removes vertices of a mesh. The others keep their order.
#pragma once

#include "core/mesh/triangle_mesh.h"

#include <cstddef>
#include <cstdint>

namespace ramus::mesh {

inline constexpr std::uint32_t kNotKept = 0xFFFFFFFFU;

// `number`: by vertex, its new index, ascending, or kNotKept. `count`: of those that are kept. Triangles whose first
// corner is removed are removed.
void keep_vertices(TriangleMesh& mesh, const LargeArray<std::uint32_t>& number, std::size_t count);

// Keeps the vertices that triangles use.
void keep_used_vertices(TriangleMesh& mesh);

} // namespace ramus::mesh
