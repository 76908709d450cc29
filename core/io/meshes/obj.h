// OBJ: text, written with the shortest numbers that read back exactly, and with vertex normals. Of what is read,
// vertices and faces alone are looked at, and the comments before them, which may say SPACE=LPS, as 3D Slicer's do:
// materials, pictures and other files that it names are not.
#pragma once

#include "core/io/meshes/mesh_file.h"

namespace ramus::io {

[[nodiscard]] Result<PolygonSoup> parse_obj(std::string_view text, const std::string& name);

// Whether a position follows nothing but comments, names and other vertices.
[[nodiscard]] bool is_obj(std::string_view head);

// The lines that say where a shape is (v, vt, vn, f), continued lines joined.
[[nodiscard]] std::string obj_shape(std::string_view text);

[[nodiscard]] std::string obj_header(const MeshCounts& counts);
void write_obj_positions(const mesh::VertexSpan& vertices, BufferedFile& file);
void write_obj_normals(const mesh::VertexSpan& vertices, BufferedFile& file);
void write_obj_faces(std::span<const glm::uvec3> triangles, const mesh::VertexSpan& vertices, BufferedFile& file);

} // namespace ramus::io
