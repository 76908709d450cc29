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

// Those of the bricks from `first` up to `end`, which are appended. Edges whose cells are all of one size and have one
// vertex each, which most are, are joined by tables and bits, a brick at a time; the others go the general way.
void join_bricks(const SurfaceCells& surface, const EdgePolygons& general, std::uint32_t first, std::uint32_t end,
                 JoinedSubtree& out);

} // namespace ramus::mesh::bricks
