// Triangle meshes from files: STL (text and binary), PLY, OBJ. Polygons are cut into triangles, vertices at one place
// become one, triangles without an area go, and all triangles are turned the same way round, outward. Then every edge
// must have exactly two triangles: a surface with holes has no inside. One that is only looked at may have holes.
// Coordinates are taken as mm, RAS.
#pragma once

#include "core/base/error.h"
#include "core/mesh/triangle_mesh.h"

#include <cstdint>
#include <filesystem>

namespace ramus::io {

inline constexpr std::uintmax_t kMostMeshBytes = std::uintmax_t{256} << 20;

enum class Holes : std::uint8_t { kRefused, kAllowed };

// Positions, triangles and unit normals per vertex. Fails, with the file's name, on what is no such file, is damaged,
// too large, empty or open, and on coordinates that make no sense in mm.
[[nodiscard]] Result<mesh::TriangleMesh> read_mesh(const std::filesystem::path& path, Holes holes = Holes::kRefused);

} // namespace ramus::io
