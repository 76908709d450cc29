// Cutting a surface along a closed line of its edges, with a cap on each side: a loop less.
#pragma once

#include "core/mesh/loops/surface_loops.h"

namespace ramus::mesh {

// A hair's breadth lies between the two caps, of the same triangles (spanning_triangles.h). The vertices of the line
// stay with what is on its left, as seen from outside; the others come behind those of the mesh, and the caps'
// triangles behind its triangles. `loop`: in order, each vertex once, of a closed, manifold surface that it does not
// part.
void cut_along(TriangleMesh& mesh, const SurfaceLoop& loop);

} // namespace ramus::mesh
