// Sizes all of a mesh's vertex arrays.
#pragma once

#include "core/mesh/triangle_mesh.h"

namespace ramus::mesh {

inline void resize_vertices(TriangleMesh& mesh, std::size_t count) {
    mesh.positions.resize(count);
    mesh.normals.resize(count);
    mesh.radii.resize(count);
    mesh.branches.resize(count);
    mesh.dominance.resize(count);
}

} // namespace ramus::mesh
