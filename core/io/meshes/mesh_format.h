// The formats of triangle meshes: one row each. A new one is a pair of files beside this and a row in mesh_format.cpp.
// Coordinates are mm, RAS. Arrays that a mesh lacks are left out of what is written. The same mesh gives the same
// bytes, whether it is written as a whole or comes in parts (surface_file.h).
#pragma once

#include "core/base/error.h"
#include "core/io/buffered_file.h"
#include "core/io/file_format.h"
#include "core/mesh/triangle_mesh.h"

#include <array>
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

// What a mesh file has: a mesh that comes in parts has all arrays.
struct MeshCounts {
    std::uint64_t vertices = 0, triangles = 0;
    bool normals = true, radii = true, branches = true;
};

struct MeshFormat : FileFormat {
    bool is_text = false;
    // `text`: all bytes of the file called `name`; null: it is not read.
    Result<PolygonSoup> (*parse)(std::string_view text, const std::string& name) = nullptr;
    // A file is the header, what each of `vertices` (null: nothing) writes, one after the other, and the triangles. Of
    // a mesh that comes in parts, binary formats are told of more and more and each function writes to a file of its
    // own until all are put together. Text is longer than the arrays: it is written at the end, from some of one array
    // at a time, the first of `vertices` from positions, the second from normals, which there always are.
    std::string (*header)(const MeshCounts&) = nullptr; // null: it is not written
    std::array<void (*)(const mesh::VertexSpan& more, BufferedFile&), 2> vertices{};
    // Given all vertices so far that `more` names.
    void (*triangles)(std::span<const glm::uvec3> more, const mesh::VertexSpan&, BufferedFile&) = nullptr;
};

[[nodiscard]] inline bool is_read(const MeshFormat& format) { return format.parse != nullptr; }
[[nodiscard]] inline bool is_written(const MeshFormat& format) { return format.header != nullptr; }

[[nodiscard]] const std::vector<MeshFormat>& mesh_formats();

// ".ply, .stl or .obj": of the formats that are read, and of those that are written.
[[nodiscard]] std::string readable_mesh_extensions();
[[nodiscard]] std::string writable_mesh_extensions();

// Whether the name is that of a mesh that can be read.
[[nodiscard]] bool names_mesh(const std::filesystem::path& path);

// The format in which `file` will be written; fails on any extension that has none.
[[nodiscard]] Result<const MeshFormat*> mesh_format(const std::filesystem::path& file);

} // namespace ramus::io
