// Sizes all of a mesh's vertex arrays, on large pages where they pay.
#pragma once

#include "core/base/huge_pages.h"
#include "core/mesh/triangle_mesh.h"

namespace ramus::mesh {

inline void resize_vertices(TriangleMesh& mesh, std::size_t count) {
    resize_large(mesh.positions, count);
    resize_large(mesh.normals, count);
    resize_large(mesh.radii, count);
    resize_large(mesh.branches, count);
}

} // namespace ramus::mesh
