// Connects the vertices of cells by triangles: one polygon around every crossed minimal edge, with the vertices of the
// circuits in the three or four cells around the edge. The mesh is closed, oriented, edge- and vertex-manifold by
// construction.
#pragma once

#include "core/mesh/polygonize/join/edge_polygons.h"

#include <cstdint>
#include <span>
#include <vector>

namespace ramus::mesh::bricks {

// The directions in which joining the polygons of a brick asks for vertices of other bricks, one bit each.
[[nodiscard]] constexpr std::uint32_t asked_by_joining(const Neighbourhood& around) {
    constexpr std::uint32_t kUpperSides = [] {
        std::uint32_t upper = 0;
        for (int d = 1; d < field::kChildren; ++d)
            upper |= std::uint32_t{1} << direction_index(d & 1, d >> 1 & 1, d >> 2);
        return upper;
    }();
    // On the lower sides another brick is responsible, unless that brick is larger.
    return around.coarser == 0 ? around.same & kUpperSides : around.same | around.coarser;
}

// Writes the polygons of some subtrees, in their order, to `joined`, whose memory is reused. The polygons contain
// indices into `vertices`. All vertices of these subtrees, and of adjacent ones in the directions of
// asked_by_joining(), must have such indices. Incomplete if cancelled.
void join_subtrees(const field::Field& field, const Octree& octree, std::span<const std::uint32_t> subtrees,
                   const SurfaceCells& surface, const VertexSpan& vertices, std::vector<JoinedSubtree>& joined,
                   const JobRange& job);

} // namespace ramus::mesh::bricks
