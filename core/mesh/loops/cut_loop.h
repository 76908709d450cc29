// Cutting a surface along a closed line of its edges, with a cap on each side: a loop less.
#pragma once

#include "core/mesh/loops/surface_loops.h"

namespace ramus::mesh {

// Cuts a closed surface along `loop` and closes both sides with caps, a hair's breadth apart: the triangles of least
// area (spanning_triangles.h), or, where one of their edges is an edge of the surface already, a fan around a new
// vertex in the middle. The loop's vertices, each once and in order, stay with the side on its left, as seen from
// outside. The vertices of the other side come behind those of the mesh, and the caps' triangles behind its triangles.
// Returns false, and cuts nothing, where the triangles at a vertex of the loop are no circle that faces one way.
[[nodiscard]] bool cut_along(TriangleMesh& mesh, const SurfaceLoop& loop);

} // namespace ramus::mesh
