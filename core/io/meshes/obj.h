// Reads and writes OBJ. Written numbers are the shortest that read back exactly; vertices have normals. The reader uses
// vertices, faces, and comments before them that state the axes as 3D Slicer does (SPACE=LPS). It ignores materials,
// images and other files.
#pragma once

#include "core/io/meshes/mesh_file.h"

namespace ramus::io {

[[nodiscard]] Result<PolygonSoup> parse_obj(std::string_view text, const std::string& name);

// Whether a vertex position comes first, after at most comments, names and other kinds of vertices.
[[nodiscard]] bool is_obj(std::string_view head);

// Only the lines of the shape (v, vt, vn, f), with continued lines joined.
[[nodiscard]] std::string obj_shape(std::string_view text);

[[nodiscard]] std::string obj_header(const MeshCounts& counts);
void write_obj_positions(const mesh::VertexSpan& vertices, BufferedFile& file);
void write_obj_normals(const mesh::VertexSpan& vertices, BufferedFile& file);
void write_obj_faces(std::span<const glm::uvec3> triangles, const mesh::VertexSpan& vertices, BufferedFile& file);

} // namespace ramus::io
