// The closed meshes that sessions name as lesions, read from their files.
#pragma once

#include "app/assets/loaded_file.h"
#include "core/measure/mesh_distance.h"
#include "core/mesh/triangle_mesh.h"

#include <filesystem>
#include <memory>

namespace ramus::app {

struct LesionMesh {
    mesh::TriangleMesh mesh; // positions, normals and triangles
    std::shared_ptr<const measure::MeshDistance> distance;
};

// The mesh in this file (core/io/meshes/mesh_file.h says which ones are taken), or `before` if the file was not written
// since; null: it was not read before. Any thread.
[[nodiscard]] Loaded<LesionMesh> read_lesion_mesh(const std::filesystem::path& file, const Loaded<LesionMesh>* before);

} // namespace ramus::app
