// PLY. Read: text and binary of either byte order, vertices and polygons; anything else in the file is skipped. Every
// count in the file is checked against what the file holds before anything is done with it. (Damaged files make assimp
// work for minutes, or worse.) Written: binary little-endian, vertex x y z nx ny nz radius (float) branch (int), faces
// as lists of uchar and int.
#pragma once

#include "core/io/meshes/mesh_file.h"

namespace ramus::io {

[[nodiscard]] bool is_ply(std::string_view head);

// `name` is what errors say.
[[nodiscard]] Result<PolygonSoup> parse_ply(std::string_view text, const std::string& name);

[[nodiscard]] std::string ply_header(const MeshCounts& counts);
void write_ply_vertices(const mesh::VertexSpan& vertices, BufferedFile& file);
void write_ply_faces(std::span<const glm::uvec3> triangles, const mesh::VertexSpan& vertices, BufferedFile& file);

} // namespace ramus::io
