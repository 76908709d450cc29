// OBJ: text, written with the shortest numbers that read back exactly, and with vertex normals.
#pragma once

#include "core/io/meshes/mesh_format.h"

namespace ramus::io {

[[nodiscard]] Result<PolygonSoup> parse_obj(std::string_view text, const std::string& name);

void write_obj(const mesh::TriangleMesh& mesh, OutputFile& file);

// Kept are vertices as in PLY, and the indices of triangles: text is much longer, and has normals after all positions.
void keep_obj_vertices(const mesh::VertexSpan& more, MeshParts& parts);
void keep_obj_triangles(std::span<const glm::uvec3> more, const mesh::VertexSpan& vertices, MeshParts& parts);
void write_obj_parts(MeshParts& parts, OutputFile& file);

} // namespace ramus::io
