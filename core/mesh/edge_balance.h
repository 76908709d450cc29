// Whether a surface is closed, found in little memory.
//
// In a closed surface every edge that one triangle runs along in one direction, another one runs along in the other.
// Each direction adds a number that is scattered from the edge's two vertices, or takes it away: the sum is 0. An open
// surface has a sum of 0 by chance alone, once in 2^64. Guaranteed: a closed surface passes. Not found: an edge with
// two triangles in each direction. Sums are kept for every thousand vertices, so that an error can say where.
#pragma once

#include "core/base/error.h"
#include "core/mesh/triangle_mesh.h"

namespace ramus::mesh {

// The error says where the surface is open first, and how many other places there are.
[[nodiscard]] Result<void> check_balance(const TriangleMesh& mesh);

} // namespace ramus::mesh
