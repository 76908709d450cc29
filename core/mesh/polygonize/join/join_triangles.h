// Joins the vertices of cells into triangles: one polygon around every minimal edge that the surface crosses, of the
// loops' vertices in the three or four cells that meet there. Closed, oriented, edge- and vertex-manifold by
// construction.
#pragma once

#include "core/mesh/polygonize/join/edge_polygons.h"

#include <span>
#include <vector>

namespace ramus::mesh::bricks {

// The polygons of some subtrees, in their order, into `joined`, which may bring memory along; by their indices in
// `vertices`, which all vertices of these subtrees and of those beside them have. Incomplete when cancelled.
void join_subtrees(const field::Field& field, const Octree& octree, std::span<const std::uint32_t> subtrees,
                   const SurfaceCells& surface, const VertexSpan& vertices, std::vector<JoinedSubtree>& joined,
                   const JobRange& job);

} // namespace ramus::mesh::bricks
