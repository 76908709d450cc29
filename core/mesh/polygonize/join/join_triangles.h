// Connects the vertices of cells by triangles: one polygon around every crossed minimal edge, with the vertices of the
// circuits in the three or four cells around the edge. The mesh is closed, oriented, edge- and vertex-manifold by
// construction.
#pragma once

#include "core/mesh/polygonize/join/edge_polygons.h"

#include <span>
#include <vector>

namespace ramus::mesh::bricks {

// Writes the polygons of some subtrees, in their order, to `joined`, whose memory is reused. The polygons contain
// indices into `vertices`. All vertices of these subtrees and of adjacent ones must have such indices. Incomplete if
// cancelled.
void join_subtrees(const field::Field& field, const Octree& octree, std::span<const std::uint32_t> subtrees,
                   const SurfaceCells& surface, const VertexSpan& vertices, std::vector<JoinedSubtree>& joined,
                   const JobRange& job);

} // namespace ramus::mesh::bricks
