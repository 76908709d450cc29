// PLY, binary little-endian: vertex x y z nx ny nz radius (float) branch (int), faces as lists of uchar and int.
#pragma once

#include "core/io/meshes/mesh_format.h"

#include <cstddef>

namespace ramus::io {

void write_ply(const mesh::TriangleMesh& mesh, OutputFile& file);

// Vertices and faces are kept as they will be in the file.
inline constexpr std::size_t kPlyVertex = 32; // bytes, when it has all arrays
void keep_ply_vertices(const mesh::VertexSpan& more, MeshParts& parts);
void keep_ply_triangles(std::span<const glm::uvec3> more, const mesh::VertexSpan& vertices, MeshParts& parts);
void write_ply_parts(MeshParts& parts, OutputFile& file);

} // namespace ramus::io
