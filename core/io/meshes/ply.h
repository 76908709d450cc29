// Reads and writes PLY. The reader accepts text and binary of either byte order, and skips all but vertices and
// polygons. It checks every count against the size of the file before it allocates memory. (assimp is not used, because
// damaged files can occupy it for minutes.) The writer writes binary little-endian: vertices x y z nx ny nz radius
// (float) branch (int), faces as lists of uchar and int.
#pragma once

#include "core/io/meshes/mesh_file.h"

namespace ramus::io {

[[nodiscard]] bool is_ply(std::string_view head);

// `name`: of the file, for errors.
[[nodiscard]] Result<PolygonSoup> parse_ply(std::string_view text, const std::string& name);

[[nodiscard]] std::string ply_header(const MeshCounts& counts);
void write_ply_vertices(const mesh::VertexSpan& vertices, BufferedFile& file);
void write_ply_faces(std::span<const glm::uvec3> triangles, const mesh::VertexSpan& vertices, BufferedFile& file);

} // namespace ramus::io
