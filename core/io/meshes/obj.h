// OBJ: text, written with the shortest numbers that read back exactly, and with vertex normals.
#pragma once

#include "core/io/meshes/mesh_file.h"

namespace ramus::io {

[[nodiscard]] std::string obj_header(const MeshCounts& counts);
void write_obj_positions(const mesh::VertexSpan& vertices, BufferedFile& file);
void write_obj_normals(const mesh::VertexSpan& vertices, BufferedFile& file);
void write_obj_faces(std::span<const glm::uvec3> triangles, const mesh::VertexSpan& vertices, BufferedFile& file);

} // namespace ramus::io
