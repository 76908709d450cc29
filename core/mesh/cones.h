// Truncated cones: the comparison method, and the picture that is there at once. One closed piece per segment: the cone
// that touches the balls of its two end points, closed by the parts of the balls beyond the touching circles. Pieces
// overlap; together they bound the union of all balls along the centerlines.
#pragma once

#include "core/base/error.h"
#include "core/base/job.h"
#include "core/mesh/triangle_mesh.h"
#include "core/tree/prepare.h"

namespace ramus::mesh {

// `detail`: sides of a cone; below 8 its ends are pyramids. Normals are exact, radius and branch per vertex as
// everywhere. Fails when cancelled or when the mesh would not fit into 32-bit indices.
[[nodiscard]] Result<TriangleMesh> cones(const tree::PreparedTree& prepared, int detail, Job& job);

} // namespace ramus::mesh
