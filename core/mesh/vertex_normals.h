// Normals of vertices.
#pragma once

#include "core/mesh/triangle_mesh.h"

namespace ramus::mesh {

// Sets the unit normal of each vertex: the mean of the normals of its triangles, weighted by their areas; (0, 0, 1)
// where that is 0.
void add_normals(TriangleMesh& mesh);

} // namespace ramus::mesh
