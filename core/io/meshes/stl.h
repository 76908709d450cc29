// STL: written as binary, one unshared triangle after the other, with the normals of the triangles; text is read too.
#pragma once

#include "core/io/meshes/mesh_format.h"

namespace ramus::io {

[[nodiscard]] Result<PolygonSoup> parse_stl(std::string_view text, const std::string& name);

void write_stl(const mesh::TriangleMesh& mesh, OutputFile& file);

// Triangles are kept as they will be in the file, vertices not at all.
void keep_stl_vertices(const mesh::VertexSpan& more, MeshParts& parts);
void keep_stl_triangles(std::span<const glm::uvec3> more, const mesh::VertexSpan& vertices, MeshParts& parts);
void write_stl_parts(MeshParts& parts, OutputFile& file);

} // namespace ramus::io
