// Reads and writes triangle meshes in all formats. The table of formats is in mesh_file.cpp; a new format is a row
// there and a reader or writer in this folder. Coordinates are mm, RAS in memory, and also in files unless they state
// other axes as 3D Slicer does: SPACE=LPS. The same mesh gives the same bytes.
//
// Meshes that are read are cleaned: polygons are triangulated, vertices with equal positions are merged, degenerate
// triangles are removed, and triangles are oriented outward. Unless holes are allowed, every edge must then have
// exactly two triangles.
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

// Largest number of vertices or triangles in a mesh file, because indices in PLY are signed.
inline constexpr std::uint64_t kMostInFile = std::numeric_limits<std::int32_t>::max();

struct PolygonSoup {
    std::vector<glm::dvec3> positions;
    std::vector<std::vector<std::uint32_t>> polygons; // indices of positions, all valid
    std::optional<Orientation> orientation;           // of the positions, if the file states it; never mirrors
};

// The content of a mesh file that is written.
struct MeshCounts {
    std::uint64_t vertices = 0, triangles = 0;
    bool normals = true, radii = true, branches = true;
    tree::Claims claims = {}; // of the tree whose surface it is
    Orientation axes = {};    // of the written vertices
    // Unit and axes as far as known, for people and for 3D Slicer: "mm, RAS; SPACE=RAS".
    [[nodiscard]] std::string claims_text() const;
};

struct MeshFormat : FileFormat {
    // Reads a file called `name` with the bytes `text`. Null: the format is not read.
    Result<PolygonSoup> (*parse)(std::string_view text, const std::string& name) = nullptr;
    // A file consists of the header, the outputs of the functions in `vertices` (null: none), and the triangles.
    std::string (*header)(const MeshCounts&) = nullptr;
    void (*triangles)(std::span<const glm::uvec3>, const mesh::VertexSpan&, BufferedFile&) = nullptr;
    std::array<void (*)(const mesh::VertexSpan&, BufferedFile&), 2> vertices{};
    // Writes a whole file instead, for formats with names and colours. `where`: the place in errors.
    Result<void> (*whole)(const mesh::TriangleMesh&, const MeshNames&, const std::string& where,
                          BufferedFile&) = nullptr;
    bool has_parts = false; // several objects, with names and colours
    double unit_mm = 1.0;   // length of the unit in which other programs see the file, in mm
    bool can_compress = false;
    bool in_files = false; // several files, which no pipe takes
};

[[nodiscard]] inline bool is_read(const MeshFormat& format) { return format.parse != nullptr; }
[[nodiscard]] inline bool is_written(const MeshFormat& format) {
    return format.header != nullptr || format.whole != nullptr;
}
[[nodiscard]] inline bool has_names(const MeshFormat& format) { return format.whole != nullptr; }

[[nodiscard]] const std::vector<MeshFormat>& mesh_formats();

// The extensions of the formats that are read, and of those that are written: ".ply, .stl or .obj".
[[nodiscard]] std::string readable_mesh_extensions();
[[nodiscard]] std::string writable_mesh_extensions();

// Whether the extension is that of a mesh format that can be read.
[[nodiscard]] bool names_mesh(const std::filesystem::path& path);

// Whether the file at `path` has a format of meshes (core/io/recognise.h). Files of VTK may hold a tree instead.
[[nodiscard]] bool may_be_mesh(const std::filesystem::path& path);

// Whether the file at `path` is a mesh. Reads files of VTK, which may also be trees: those without lines are meshes.
[[nodiscard]] bool is_mesh(const std::filesystem::path& path);

// The format for writing `file`, by its extension. Fails if no written format has the extension.
[[nodiscard]] Result<const MeshFormat*> mesh_format(const std::filesystem::path& file);

inline constexpr std::uintmax_t kMostMeshBytes = std::uintmax_t{256} << 20;

// kAllowed: for meshes that are only displayed.
enum class Holes : std::uint8_t { kRefused, kAllowed };

// Options for reading a mesh.
struct MeshReading {
    Holes holes = Holes::kRefused;
    std::optional<Orientation> orientation; // RAS or LPS, used if the file states none; none: RAS is assumed
};

struct MeshFile {
    mesh::TriangleMesh mesh;           // positions, triangles and unit normals per vertex; mm, RAS
    std::optional<Orientation> stated; // axes that the file states
    tree::SaidBy axes = tree::SaidBy::kNobody;
};

// Reads a mesh of at most kMostMeshBytes. recognise.h decides the format. Fails, with the file's name, if the file is
// no mesh, damaged, too large, empty or (unless allowed) open, and on coordinates that are impossible in mm.
[[nodiscard]] Result<MeshFile> read_mesh_file(const std::filesystem::path& path, const MeshReading& reading);
// The same; returns the mesh alone.
[[nodiscard]] Result<mesh::TriangleMesh> read_mesh(const std::filesystem::path& path, Holes holes = Holes::kRefused);

// Writes in the format of the extension and in the axes of `names`. Its other members are written if the format can
// hold them. Takes the mesh by value because it converts the axes in place: move a mesh that is not needed any more.
[[nodiscard]] Result<void> write_mesh(mesh::TriangleMesh mesh, const std::filesystem::path& file,
                                      const MeshNames& names = {});

} // namespace ramus::io
