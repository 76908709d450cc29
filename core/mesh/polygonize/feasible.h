// Checks, before any work starts, whether a surface can be made.
#pragma once

#include "core/mesh/polygonize/octree/sizing.h"
#include "core/mesh/polygonize/polygonize.h"

namespace ramus::mesh {

// Fails if the tree has no segments, or if all are hidden.
[[nodiscard]] Result<void> check_segments(const field::Field& field);

// Fails if the forecast memory of the surface in this mode exceeds the options' limit, if the cells are too fine for
// the integers of the lattice, or if they are too fine for single precision at the tree's distance from the origin.
// `share`: of the surface that is made.
[[nodiscard]] Result<void> check_feasible(const field::Field& field, const bricks::Sizing& sizing,
                                          const PolygonizeOptions& options, PolygonizeMode mode, double share = 1.0);

} // namespace ramus::mesh
