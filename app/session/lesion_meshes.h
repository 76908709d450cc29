// The lesion meshes that sessions name, each read once. A session says file names only (app/session/session.h), and
// pictures, distances and tables all want the same mesh: this keeps it for them. Safe to ask from any thread.
#pragma once

#include "core/base/error.h"
#include "core/measure/mesh_distance.h"
#include "core/mesh/triangle_mesh.h"

#include <filesystem>
#include <memory>

namespace ramus::app {

struct LesionMesh {
    mesh::TriangleMesh mesh; // positions, normals and triangles
    std::shared_ptr<const measure::MeshDistance> distance;
};

// The mesh in this file (core/io/mesh_reader.h says which ones are taken). A file is read again when it was written
// since; one that could not be read says so again without another try until it changes.
[[nodiscard]] Result<std::shared_ptr<const LesionMesh>> lesion_mesh(const std::filesystem::path& path);

// The same without touching the disk or waiting for who does: null when it has not been read.
[[nodiscard]] std::shared_ptr<const LesionMesh> lesion_mesh_read_before(const std::filesystem::path& path);

} // namespace ramus::app
