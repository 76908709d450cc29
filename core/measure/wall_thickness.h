// How thick a solid is at its thinnest places: what a printer has to be able to make.
#pragma once

#include "core/mesh/triangle_mesh.h"
#include "core/tree/vessel_tree.h"

#include <glm/vec3.hpp>
#include <vector>

namespace ramus::measure {

struct Thickness {
    double mm = 0.0;
    glm::vec3 at{0.0F};           // on the surface; mm, RAS
    int branch = tree::kNoBranch; // of a mesh that knows branches
};

// The thickness at a vertex is the length of the way straight inward, against the normal, to where the surface faces
// back: to within 10 degrees the two sides are parallel. That is the diameter of a tube, less what flat triangles cut
// off, the narrowest section of a stenosis, and the thickness of a plate. An edge or a ridge of a thick solid has no
// thickness, nor has a vertex that a triangle faces away from, as where a crease is narrower than the triangles. The
// result has one entry for each branch with such a vertex, the thinnest first; a mesh without branches has one. The
// mesh is closed and has normals. Takes about 50 bytes for a triangle. `threads`: 0: all cores.
[[nodiscard]] std::vector<Thickness> least_thicknesses(const mesh::TriangleMesh& mesh, int threads = 0);

} // namespace ramus::measure
