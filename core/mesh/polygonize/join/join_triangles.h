// Joins the vertices of cells into triangles: one polygon around every minimal edge that the surface crosses, of the
// loops' vertices in the three or four cells that meet there.
#pragma once

#include "core/mesh/polygonize/cells/brick_cells.h"

namespace ramus::mesh::bricks {

// Closed, oriented, edge- and vertex-manifold by construction. `surface` is consumed. Empty when cancelled.
[[nodiscard]] TriangleMesh join_triangles(const field::ConvolutionField& field, const Octree& octree,
                                          SurfaceCells surface, Job& job);

} // namespace ramus::mesh::bricks
