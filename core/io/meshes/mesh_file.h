// Triangle meshes from and to files, in any of the formats of meshes/mesh_format.h. What is read is tidied: polygons
// are cut into triangles, vertices at one position become one, triangles without an area go, and all triangles are
// turned the same way round, outward. Then every edge must have exactly two triangles: a surface with holes has no
// inside. Coordinates are taken as mm, RAS.
#pragma once

#include "core/io/meshes/mesh_format.h"

namespace ramus::io {

inline constexpr std::uintmax_t kMostMeshBytes = std::uintmax_t{256} << 20;

// kAllowed: for meshes that are only looked at.
enum class Holes : std::uint8_t { kRefused, kAllowed };

// Positions, triangles and unit normals per vertex. The content of the file says which format it has, and where it does
// not, the extension. Fails, with the file's name, on what is no such file, is damaged, too large, empty or open, and
// on coordinates that make no sense in mm.
[[nodiscard]] Result<mesh::TriangleMesh> read_mesh(const std::filesystem::path& path, Holes holes = Holes::kRefused);

// In the format of the extension.
[[nodiscard]] Result<void> write_mesh(const mesh::TriangleMesh& mesh, const std::filesystem::path& file);

[[nodiscard]] tl::unexpected<Error> too_many_for_file(const std::filesystem::path& path);

} // namespace ramus::io
