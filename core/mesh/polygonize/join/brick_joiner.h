// The quads of bricks' edges whose cells are all of one size and have one vertex each, which most are: by tables and
// bits, a brick at a time. The others go the general way (EdgePolygons).
#pragma once

#include "core/mesh/polygonize/join/edge_polygons.h"

#include <cstdint>

namespace ramus::mesh::bricks {

// Appends the polygons of the bricks from `first` up to `end`.
void join_bricks(const SurfaceCells& surface, const EdgePolygons& general, std::uint32_t first, std::uint32_t end,
                 JoinedSubtree& out);

} // namespace ramus::mesh::bricks
