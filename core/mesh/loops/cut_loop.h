// Cutting a surface along a closed line of its edges, with a cap on each side: a loop less.
#pragma once

#include "core/mesh/loops/surface_loops.h"

namespace ramus::mesh {

// Whether no edge within the caps of a line is one of the surface already: it would have four triangles.
[[nodiscard]] bool has_free_cap(const SurfaceGraph& graph, const SurfaceLoop& loop);

// A hair's breadth lies between the two caps, of the same triangles (spanning_triangles.h). The vertices of the line
// stay with what is on its left, as seen from outside; the others come behind those of the mesh, and the caps'
// triangles behind its triangles. `loop`: in order, each vertex once, of a closed surface that it does not part, with
// free caps. False, and nothing is cut, where the triangles at a vertex of it do not lie around that in a circle, all
// facing one way.
[[nodiscard]] bool cut_along(TriangleMesh& mesh, const SurfaceLoop& loop);

} // namespace ramus::mesh
