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

// The thickness at a vertex is the way from there straight inward, against the normal, to where the solid ends: of a
// tube its diameter, less what flat triangles cut off. One entry for each branch of the mesh, the thinnest first; a
// mesh without branches has one. The mesh is closed and has normals. Takes about 150 bytes for a triangle. `threads`:
// 0: all cores.
[[nodiscard]] std::vector<Thickness> least_thicknesses(const mesh::TriangleMesh& mesh, int threads = 0);

} // namespace ramus::measure
