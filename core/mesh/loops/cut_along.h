// Cuts a surface along a closed line of its edges and caps both sides, which removes one loop.
#pragma once

#include "core/mesh/loops/closed_lines.h"

namespace ramus::mesh {

// Cuts a closed surface along `line` and closes both sides with caps that have a tiny gap between them. A cap consists
// of the triangles of least area (spanning_triangles.h), or of a fan around a new vertex in the middle if one of their
// edges is already an edge of the surface. The vertices of the line, each once and in order, stay with the side on its
// left, seen from outside. New vertices and triangles are appended to the mesh. Returns false, and changes nothing, if
// the triangles at a vertex of the line do not form a consistently oriented fan.
[[nodiscard]] bool cut_along(TriangleMesh& mesh, const ClosedLine& line);

} // namespace ramus::mesh
