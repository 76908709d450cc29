// Folds: where a surface turns over. What goes through itself within a few triangles does so there.
#pragma once

#include "core/mesh/triangle_mesh.h"
#include "core/mesh/untangle/triangle_boxes.h"

#include <cstdint>
#include <vector>

namespace ramus::mesh {

struct Folds {
    // Ascending: what faces away from the normal at one of its corners, or has no area; and what shares a corner with
    // these.
    std::vector<std::uint32_t> triangles;
    TriangleBoxes boxes; // of the whole surface
};
// The surface has normals, and must outlive the boxes.
[[nodiscard]] Folds find_folds(const TriangleMesh& mesh);

} // namespace ramus::mesh
