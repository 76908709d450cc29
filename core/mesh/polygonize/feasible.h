// Whether a surface can be made at all, told before anything is.
#pragma once

#include "core/mesh/polygonize/octree/sizing.h"
#include "core/mesh/polygonize/polygonize.h"

namespace ramus::mesh {

// Fails when the surface, made in that mode, is forecast to take more memory than the options allow, and on cells finer
// than the lattice counts, or than single precision tells apart where the tree is.
[[nodiscard]] Result<void> check_feasible(const field::Field& field, const bricks::Sizing& sizing,
                                          const PolygonizeOptions& options, PolygonizeMode mode);

// The same of a field whose sizing nobody needs.
[[nodiscard]] Result<void> check_feasible(const field::Field& field, const PolygonizeOptions& options,
                                          PolygonizeMode mode);

} // namespace ramus::mesh
