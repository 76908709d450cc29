// A mesh with fewer triangles for while the view moves, and normals without the steps of voxels for surfaces of masks.
#pragma once

#include "core/mesh/triangle_mesh.h"

#include <cstddef>

namespace ramus::mesh {

// About so many triangles, or fewer: vertices of one cell of a grid become one, in their middle (Rossignac and Borrel,
// 1993). What is thinner than a cell may fall together; of a closed surface every edge is still met as often from one
// side as from the other. Positions, normals and triangles.
[[nodiscard]] TriangleMesh coarse_mesh(const TriangleMesh& mesh, std::size_t triangles);

// Each normal becomes the mean over the triangles around its vertex, so many times over. Positions stay.
void smooth_normals(TriangleMesh& mesh, int passes);

} // namespace ramus::mesh
