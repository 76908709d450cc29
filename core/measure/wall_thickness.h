// Finds the thinnest places of a solid, which a 3D printer must be able to print.
#pragma once

#include "core/mesh/triangle_mesh.h"
#include "core/tree/vessel_tree.h"

#include <glm/vec3.hpp>
#include <vector>

namespace ramus::measure {

struct Thickness {
    double mm = 0.0;
    glm::vec3 at{0.0F};           // on the surface; mm, RAS
    int branch = tree::kNoBranch; // if the mesh has branches
};

// The thickness at a vertex is the length of the straight way inward, against the normal, to the opposite side, if the
// two sides are parallel within 10 degrees. That is the diameter of a tube (less the error of flat triangles), the
// narrowest section of a stenosis, or the thickness of a plate. An edge or ridge of a thick solid has no thickness, and
// neither has a vertex with a triangle that faces away from its normal, as in a crease narrower than the triangles.
//
// Returns one entry for each branch that has a thickness, the thinnest first; one entry for a mesh without branches.
// The mesh must be closed and have normals. Needs about 50 bytes for each triangle. `threads`: 0 means all cores.
[[nodiscard]] std::vector<Thickness> least_thicknesses(const mesh::TriangleMesh& mesh, int threads = 0);

} // namespace ramus::measure
