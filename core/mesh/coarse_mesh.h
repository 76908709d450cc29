// Simplifies a mesh for previews, and smooths the normals of surfaces of masks.
#pragma once

#include "core/mesh/triangle_mesh.h"

#include <cstddef>

namespace ramus::mesh {

// A mesh with about `triangles` triangles or fewer, by vertex clustering: the vertices in one cell of a grid are merged
// at their mean (Rossignac and Borrel, 1993). Parts thinner than a cell may collapse. In the result of a closed
// surface, every edge still occurs as often in one direction as in the other. The result has positions, normals and
// triangles only.
[[nodiscard]] TriangleMesh coarse_mesh(const TriangleMesh& mesh, std::size_t triangles);

// Replaces each normal by the mean over the triangles around its vertex, `passes` times. Positions do not change.
void smooth_normals(TriangleMesh& mesh, int passes);

} // namespace ramus::mesh
