// Triangle meshes from and to files: the formats, one row each, and the functions that read and write them all. A new
// format is a pair of files beside this and a row in mesh_file.cpp. Coordinates are mm, RAS, in memory, and in files
// unless they say otherwise as 3D Slicer's do: SPACE=LPS. Arrays that a mesh lacks are left out of what is written; the
// same mesh gives the same bytes.
//
// What is read is tidied: polygons are cut into triangles, vertices at one position become one, triangles without an
// area go, and all triangles are turned the same way round, outward. Then every edge must have exactly two triangles: a
// surface with holes has no inside.
#pragma once

#include "core/base/error.h"
#include "core/io/buffered_file.h"
#include "core/io/file_format.h"
#include "core/io/meshes/mesh_names.h"
#include "core/io/orientation.h"
#include "core/mesh/triangle_mesh.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <glm/vec3.hpp>
#include <limits>
#include <optional>
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
    std::optional<Orientation> orientation;           // of the positions, where the file states it; none mirrors
};

// What a mesh file has.
struct MeshCounts {
    std::uint64_t vertices = 0, triangles = 0;
    bool normals = true, radii = true, branches = true;
    tree::Claims claims = {}; // of the tree that it is the surface of
    Orientation axes = {};    // that the vertices are written in
    // "mm, RAS; SPACE=RAS", as far as that is known: for people, and for 3D Slicer.
    [[nodiscard]] std::string claims_text() const;
};

struct MeshFormat : FileFormat {
    // `text`: all bytes of the file called `name`; null: it is not read.
    Result<PolygonSoup> (*parse)(std::string_view text, const std::string& name) = nullptr;
    // A file is the header, what each of `vertices` (null: nothing) writes, one after the other, and the triangles.
    std::string (*header)(const MeshCounts&) = nullptr;
    void (*triangles)(std::span<const glm::uvec3>, const mesh::VertexSpan&, BufferedFile&) = nullptr;
    std::array<void (*)(const mesh::VertexSpan&, BufferedFile&), 2> vertices{};
    // Instead of these: a format that has names and colours too. `where`: what errors name.
    Result<void> (*whole)(const mesh::TriangleMesh&, const MeshNames&, const std::string& where,
                          BufferedFile&) = nullptr;
    bool has_parts = false; // objects of their own, with names and colours
    double unit_mm = 1.0;   // what programs take the file's unit for, once they have heeded what it says
};

[[nodiscard]] inline bool is_read(const MeshFormat& format) { return format.parse != nullptr; }
[[nodiscard]] inline bool is_written(const MeshFormat& format) {
    return format.header != nullptr || format.whole != nullptr;
}
[[nodiscard]] inline bool has_names(const MeshFormat& format) { return format.whole != nullptr; }

[[nodiscard]] const std::vector<MeshFormat>& mesh_formats();

// ".ply, .stl or .obj": of the formats that are read, and of those that are written.
[[nodiscard]] std::string readable_mesh_extensions();
[[nodiscard]] std::string writable_mesh_extensions();

// Whether the name is that of a mesh that can be read.
[[nodiscard]] bool names_mesh(const std::filesystem::path& path);

// Whether the file at `path` has a format that meshes have (core/io/recognise.h): read_mesh_file() says what else it
// is.
[[nodiscard]] bool may_be_mesh(const std::filesystem::path& path);

// Whether there is a mesh at `path`. Files of VTK, which trees have too, are read for it: those
// without lines are meshes.
[[nodiscard]] bool is_mesh(const std::filesystem::path& path);

// The format in which `file` will be written; fails on any extension that has none.
[[nodiscard]] Result<const MeshFormat*> mesh_format(const std::filesystem::path& file);

inline constexpr std::uintmax_t kMostMeshBytes = std::uintmax_t{256} << 20;

// kAllowed: for meshes that are only looked at.
enum class Holes : std::uint8_t { kRefused, kAllowed };

// What a person says about a mesh's file.
struct MeshReading {
    Holes holes = Holes::kRefused;
    std::optional<Orientation> orientation; // of a file that does not state it: RAS or LPS; none: RAS is assumed
};

struct MeshFile {
    mesh::TriangleMesh mesh;           // positions, triangles and unit normals per vertex; mm, RAS
    std::optional<Orientation> stated; // by the file
    tree::SaidBy axes = tree::SaidBy::kNobody;
};

// The content of the file says which format it has, and where it does not, the extension. Fails, with the file's name,
// on what is no such file, is damaged, too large, empty or open, and on coordinates that make no sense in mm.
[[nodiscard]] Result<MeshFile> read_mesh_file(const std::filesystem::path& path, const MeshReading& reading);
// The mesh alone.
[[nodiscard]] Result<mesh::TriangleMesh> read_mesh(const std::filesystem::path& path, Holes holes = Holes::kRefused);

// In the format of the extension, in the axes of `names`, whose other members are for formats that have a place for
// them. The mesh is turned into the axes in place: pass by std::move what is not needed any more.
[[nodiscard]] Result<void> write_mesh(mesh::TriangleMesh mesh, const std::filesystem::path& file,
                                      const MeshNames& names = {});

} // namespace ramus::io
