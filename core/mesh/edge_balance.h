// Checks that a surface is closed, in little memory, by hashing edges.
//
// In a closed oriented surface every directed edge of a triangle has an opposite edge in another triangle. Each
// directed edge adds the hash of its two vertices, and the opposite direction subtracts it, so the sum is 0.
// Guaranteed: a closed surface passes. An open surface passes with a probability of 2^-64. Not detected: an edge with
// two triangles in each direction. There is one sum for every thousand vertices, so that an error can say where the
// surface is open.
#pragma once

#include "core/base/error.h"
#include "core/mesh/triangle_mesh.h"

namespace ramus::mesh {

// The error gives the first open place, and the number of further ones.
[[nodiscard]] Result<void> check_balance(const TriangleMesh& mesh);

} // namespace ramus::mesh
