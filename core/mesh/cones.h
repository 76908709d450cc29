// Truncated cones: the comparison method, and a fast preview. One closed piece per segment: the cone tangent to the
// spheres of its two end points, closed by the parts of the spheres beyond the circles of tangency. Pieces overlap;
// together they bound the union of all spheres along the centerlines.
#pragma once

#include "core/base/error.h"
#include "core/base/job.h"
#include "core/mesh/triangle_mesh.h"
#include "core/tree/prepare.h"

namespace ramus::mesh {

// `detail`: the number of sides of a cone; below 8 its ends are pyramids. Normals are exact; every vertex has a radius
// and a branch. Fails if cancelled, and if the mesh does not fit into 32-bit indices.
[[nodiscard]] Result<TriangleMesh> cones(const tree::PreparedTree& prepared, int detail, Job& job);

} // namespace ramus::mesh
