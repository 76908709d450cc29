// STL: written as binary, one unshared triangle after the other, with the normals of the triangles; text is read too.
// The header, of 80 bytes in binary files and the first line of text, may say SPACE=LPS, as 3D Slicer's does.
#pragma once

#include "core/io/meshes/mesh_file.h"

namespace ramus::io {

// Whether it is text that begins with a solid, or a whole triangle follows a header of 80 bytes and a count.
[[nodiscard]] bool is_stl(std::string_view head);
[[nodiscard]] Result<PolygonSoup> parse_stl(std::string_view text, const std::string& name);

[[nodiscard]] std::string stl_header(const MeshCounts& counts);
void write_stl_facets(std::span<const glm::uvec3> triangles, const mesh::VertexSpan& vertices, BufferedFile& file);

} // namespace ramus::io
