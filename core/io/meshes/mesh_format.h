// The formats of triangle meshes: one row each. A new one is a pair of files beside this and a row in mesh_format.cpp.
// Coordinates are mm, RAS. Arrays that a mesh lacks are left out of what is written. The same mesh gives the same
// bytes, whether it is written as a whole or comes in parts (surface_file.h).
#pragma once

#include "core/base/error.h"
#include "core/io/file_format.h"
#include "core/io/output_file.h"
#include "core/io/temporary_file.h"
#include "core/mesh/triangle_mesh.h"

#include <cstdint>
#include <filesystem>
#include <glm/vec3.hpp>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace ramus::io {

// Most vertices or triangles of a mesh file: PLY's indices are signed.
inline constexpr std::uint64_t kMostInFile = std::numeric_limits<std::int32_t>::max();

struct PolygonSoup {
    std::vector<glm::dvec3> positions;
    std::vector<std::vector<std::uint32_t>> polygons; // every index is that of a position
};

// A mesh whose parts wait on the disk until all have come, each kept as its format finds useful. Its vertices have all
// arrays.
struct MeshParts {
    TemporaryFile vertices, triangles;
    std::uint64_t vertex_count = 0, triangle_count = 0;
};

struct MeshFormat : FileFormat {
    // `text`: all bytes of the file called `name`; null: it is not read.
    Result<PolygonSoup> (*parse)(std::string_view text, const std::string& name) = nullptr;
    // null: it is not written.
    void (*write)(const mesh::TriangleMesh&, OutputFile&) = nullptr;
    // Of a mesh that comes in parts: keeps more vertices; keeps more triangles, given all vertices so far that they
    // name; writes the file from what was kept.
    void (*keep_vertices)(const mesh::VertexSpan&, MeshParts&) = nullptr;
    void (*keep_triangles)(std::span<const glm::uvec3>, const mesh::VertexSpan&, MeshParts&) = nullptr;
    void (*write_parts)(MeshParts&, OutputFile&) = nullptr;
};

[[nodiscard]] inline bool is_read(const MeshFormat& format) { return format.parse != nullptr; }
[[nodiscard]] inline bool is_written(const MeshFormat& format) { return format.write != nullptr; }

[[nodiscard]] const std::vector<MeshFormat>& mesh_formats();

// ".ply, .stl or .obj": of the formats that are read, and of those that are written.
[[nodiscard]] std::string readable_mesh_extensions();
[[nodiscard]] std::string writable_mesh_extensions();

// Whether the name is that of a mesh that can be read.
[[nodiscard]] bool names_mesh(const std::filesystem::path& path);

// The format in which `file` will be written; fails on any extension that has none.
[[nodiscard]] Result<const MeshFormat*> mesh_format(const std::filesystem::path& file);

} // namespace ramus::io
