// Finds folds: triangles where a surface turns over. A surface that intersects itself within a few triangles has a fold
// there.
#pragma once

#include "core/mesh/triangle_mesh.h"
#include "core/mesh/untangle/triangle_boxes.h"

#include <cstdint>

namespace ramus::mesh {

struct Folds {
    // Triangles that face away from the normal of one of their corners or have no area, and triangles that share a
    // corner with these; ascending.
    LargeArray<std::uint32_t> triangles;
    TriangleBoxes boxes; // of the whole surface
};
// The surface must have normals, and must outlive the boxes.
[[nodiscard]] Folds find_folds(const TriangleMesh& mesh);

} // namespace ramus::mesh
