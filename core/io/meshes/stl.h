// Reads and writes STL. Written files are binary: independent triangles with their normals. Text is read too. The
// header (80 bytes in binary files, the first line of text) may state the axes as 3D Slicer does: SPACE=LPS.
#pragma once

#include "core/io/meshes/mesh_file.h"

namespace ramus::io {

// Whether `head` is text with "solid" and a facet, or a header of 80 bytes, a count and valid triangles.
[[nodiscard]] bool is_stl(std::string_view head);
[[nodiscard]] Result<PolygonSoup> parse_stl(std::string_view text, const std::string& name);

[[nodiscard]] std::string stl_header(const MeshCounts& counts);
void write_stl_facets(std::span<const glm::uvec3> triangles, const mesh::VertexSpan& vertices, BufferedFile& file);

} // namespace ramus::io
