// How the parts of a mesh are written in each format (core/io/mesh_writer.h), for whole meshes and for those that come
// in parts.
#pragma once

#include "core/io/output_file.h"
#include "core/mesh/triangle_mesh.h"

#include <array>
#include <bit>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <glm/vec3.hpp>
#include <limits>
#include <string>
#include <string_view>

namespace ramus::io {

static_assert(std::endian::native == std::endian::little, "PLY and STL are written as they lie in memory");

// Most vertices or triangles of a mesh file: PLY's indices are signed.
inline constexpr std::uint64_t kMostInFile = std::numeric_limits<std::int32_t>::max();
[[nodiscard]] tl::unexpected<Error> too_many_for_file(const std::string& path);

// One record of a binary file, put together before it is written.
template <std::size_t Size> class Record {
public:
    template <class T> void put(const T& value) {
        std::memcpy(bytes_.data() + used_, &value, sizeof(T));
        used_ += sizeof(T);
    }
    template <class File> void write(File& file) {
        file.write(bytes_.data(), used_);
        used_ = 0;
    }

private:
    std::array<std::byte, Size> bytes_;
    std::size_t used_ = 0;
};

// Which of the arrays a mesh has.
struct VertexArrays {
    bool normals = true, radii = true, branches = true;
};
[[nodiscard]] std::string ply_header(VertexArrays arrays, std::uint64_t vertices, std::uint64_t triangles);

inline constexpr std::size_t kPlyVertex = 32; // bytes, when it has all arrays
template <class File> void write_ply_vertices(const mesh::VertexSpan& vertices, File& file) {
    Record<kPlyVertex> vertex;
    for (std::size_t v = 0; v < vertices.size(); ++v) {
        vertex.put(vertices.positions[v]);
        if (!vertices.normals.empty()) vertex.put(vertices.normals[v]);
        if (!vertices.radii.empty()) vertex.put(vertices.radii[v]);
        if (!vertices.branches.empty()) vertex.put(vertices.branches[v]);
        vertex.write(file);
    }
}

inline constexpr std::size_t kPlyFace = 13; // bytes
[[nodiscard]] inline Record<kPlyFace> ply_face(const glm::uvec3& triangle) {
    Record<kPlyFace> face;
    face.put(std::uint8_t{3});
    face.put(triangle);
    return face;
}

[[nodiscard]] std::string stl_header(std::uint64_t triangles);
inline constexpr std::size_t kStlFacet = 50; // bytes
[[nodiscard]] Record<kStlFacet> stl_facet(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c);

// Lines of an OBJ file, put together without the locale.
[[nodiscard]] std::string_view obj_header();
class ObjLines {
public:
    explicit ObjLines(OutputFile& file) : file_(file) {}
    void vector(std::string_view name, const glm::vec3& vector);
    void face(const glm::uvec3& triangle, bool with_normals);

private:
    void text(std::string_view word);
    template <class T> void number(T value) { next_ = std::to_chars(next_, bytes_.data() + bytes_.size(), value).ptr; }
    void end();

    OutputFile& file_;
    std::array<char, 128> bytes_; // three pairs of 10-digit indices, or three floats, and what stands between them
    char* next_ = bytes_.data();
};

} // namespace ramus::io
