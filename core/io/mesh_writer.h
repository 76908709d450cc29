// Triangle meshes as files; the extension chooses the format. Coordinates are mm (RAS) as in the mesh.
//   .ply  binary little-endian; vertex x y z nx ny nz radius (float) branch (int), face lists of uchar and int
//   .stl  binary, one unshared triangle after the other, with facet normals
//   .obj  text, shortest numbers that read back exactly, with vertex normals
// Arrays that the mesh lacks are left out. The same mesh gives the same bytes.
#pragma once

#include "core/base/error.h"
#include "core/mesh/triangle_mesh.h"

#include <filesystem>

namespace ramus::io {

enum class MeshFormat { kPly, kStl, kObj };

// The format that `file` asks for; fails on any other extension.
[[nodiscard]] Result<MeshFormat> mesh_format(const std::filesystem::path& file);

[[nodiscard]] Result<void> write_mesh(const mesh::TriangleMesh& mesh, const std::filesystem::path& file);

} // namespace ramus::io
