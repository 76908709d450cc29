// Writes a surface as PVTP: a file that names pieces, each a VTP file with triangles of its own, so that ParaView reads
// them by several processes, and people one at a time.
#pragma once

#include "core/base/error.h"
#include "core/io/buffered_file.h"
#include "core/io/meshes/mesh_names.h"
#include "core/mesh/triangle_mesh.h"

#include <string>

namespace ramus::io {

// Writes MeshNames::pieces files beside `where`, "tree.pvtp": "tree_0.vtp" and so on, and to `file` what names them.
// Vertices between pieces are in both. Takes the memory of a piece, and four bytes for each vertex in the mesh's own.
[[nodiscard]] Result<void> write_pvtp_surface(const mesh::TriangleMesh& mesh, const MeshNames& names,
                                              const std::string& where, BufferedFile& file);

} // namespace ramus::io
