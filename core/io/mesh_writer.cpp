#include "core/io/mesh_writer.h"

#include "core/io/output_file.h"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cstdint>
#include <glm/geometric.hpp>
#include <limits>
#include <string>

namespace ramus::io {

namespace {

static_assert(std::endian::native == std::endian::little, "PLY and STL are written as they lie in memory");

// One record of a binary file, put together before it is written.
template <std::size_t Size> class Record {
public:
    template <class T> void put(const T& value) {
        std::memcpy(bytes_.data() + used_, &value, sizeof(T));
        used_ += sizeof(T);
    }
    void write(OutputFile& file) {
        file.write(bytes_.data(), used_);
        used_ = 0;
    }

private:
    std::array<std::byte, Size> bytes_;
    std::size_t used_ = 0;
};

void write_ply(const mesh::TriangleMesh& mesh, OutputFile& file) {
    std::string header = "ply\nformat binary_little_endian 1.0\ncomment ramus " RAMUS_VERSION ", mm, RAS\n"
                         "element vertex " +
                         std::to_string(mesh.positions.size()) +
                         "\nproperty float x\nproperty float y\nproperty float z\n";
    if (!mesh.normals.empty()) header += "property float nx\nproperty float ny\nproperty float nz\n";
    if (!mesh.radii.empty()) header += "property float radius\n";
    if (!mesh.branches.empty()) header += "property int branch\n";
    header += "element face " + std::to_string(mesh.triangles.size()) +
              "\nproperty list uchar int vertex_indices\nend_header\n";
    file.write(header);

    Record<32> vertex;
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
        vertex.put(mesh.positions[v]);
        if (!mesh.normals.empty()) vertex.put(mesh.normals[v]);
        if (!mesh.radii.empty()) vertex.put(mesh.radii[v]);
        if (!mesh.branches.empty()) vertex.put(mesh.branches[v]);
        vertex.write(file);
    }
    Record<13> face;
    for (const glm::uvec3& triangle : mesh.triangles) {
        face.put(std::uint8_t{3});
        face.put(triangle);
        face.write(file);
    }
}

void write_stl(const mesh::TriangleMesh& mesh, OutputFile& file) {
    // A binary file must not begin with "solid", or programs take it for text.
    std::string header = "ramus " RAMUS_VERSION ", mm, RAS";
    header.resize(80, ' ');
    file.write(header);
    const auto count = static_cast<std::uint32_t>(mesh.triangles.size());
    file.write(&count, sizeof count);

    Record<50> facet;
    for (const glm::uvec3& triangle : mesh.triangles) {
        const glm::vec3& a = mesh.positions[triangle.x];
        const glm::vec3& b = mesh.positions[triangle.y];
        const glm::vec3& c = mesh.positions[triangle.z];
        // In double precision: the square of a small triangle's area leaves single precision.
        const glm::dvec3 across = glm::cross(glm::dvec3(b) - glm::dvec3(a), glm::dvec3(c) - glm::dvec3(a));
        const double length = glm::length(across);
        facet.put(length > 0.0 ? glm::vec3(across / length) : glm::vec3(0.0F));
        facet.put(a);
        facet.put(b);
        facet.put(c);
        facet.put(std::uint16_t{0});
        facet.write(file);
    }
}

// Lines of text, put together without the locale.
class Line {
public:
    void text(std::string_view word) { next_ = std::ranges::copy(word, next_).out; }
    template <class T> void number(T value) { next_ = std::to_chars(next_, bytes_.data() + bytes_.size(), value).ptr; }
    void write(OutputFile& file) {
        *next_++ = '\n';
        file.write(bytes_.data(), static_cast<std::size_t>(next_ - bytes_.data()));
        next_ = bytes_.data();
    }

private:
    std::array<char, 128> bytes_; // three pairs of 10-digit indices, or three floats, and what stands between them
    char* next_ = bytes_.data();
};

void write_obj(const mesh::TriangleMesh& mesh, OutputFile& file) {
    file.write("# ramus " RAMUS_VERSION ", mm, RAS\n");
    Line line;
    const auto write_vectors = [&](std::string_view name, const LargeArray<glm::vec3>& vectors) {
        for (const glm::vec3& vector : vectors) {
            line.text(name);
            for (int axis = 0; axis < 3; ++axis) {
                line.text(" ");
                line.number(vector[axis]);
            }
            line.write(file);
        }
    };
    write_vectors("v", mesh.positions);
    write_vectors("vn", mesh.normals);
    for (const glm::uvec3& triangle : mesh.triangles) {
        line.text("f");
        for (int corner = 0; corner < 3; ++corner) {
            const std::uint64_t index = std::uint64_t{triangle[corner]} + 1;
            line.text(" ");
            line.number(index);
            if (mesh.normals.empty()) continue;
            line.text("//");
            line.number(index);
        }
        line.write(file);
    }
}

} // namespace

Result<MeshFormat> mesh_format(const std::filesystem::path& file) {
    std::string extension = file.extension().string();
    std::ranges::transform(extension, extension.begin(),
                           [](char c) { return static_cast<char>(c >= 'A' && c <= 'Z' ? c + 32 : c); });
    if (extension == ".ply") return MeshFormat::kPly;
    if (extension == ".stl") return MeshFormat::kStl;
    if (extension == ".obj") return MeshFormat::kObj;
    return fail(extension.empty() ? "has no extension that names a mesh format"
                                  : "meshes of type '" + extension + "' cannot be written",
                file.string(), "use .ply, .stl or .obj");
}

Result<void> write_mesh(const mesh::TriangleMesh& mesh, const std::filesystem::path& path) {
    const auto format = mesh_format(path);
    if (!format) return tl::unexpected(format.error());
    // PLY's indices are signed.
    constexpr std::size_t kMost = std::numeric_limits<std::int32_t>::max();
    if (mesh.positions.size() > kMost || mesh.triangles.size() > kMost)
        return fail("the mesh has more triangles than its format can count", path.string(), "use a lower --detail");
    auto file = OutputFile::create(path);
    if (!file) return tl::unexpected(file.error());
    switch (*format) {
    case MeshFormat::kPly:
        write_ply(mesh, *file);
        break;
    case MeshFormat::kStl:
        write_stl(mesh, *file);
        break;
    case MeshFormat::kObj:
        write_obj(mesh, *file);
        break;
    }
    return file->commit();
}

} // namespace ramus::io
