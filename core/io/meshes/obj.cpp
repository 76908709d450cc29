#include "core/io/meshes/obj.h"

#include "core/io/meshes/assimp_reader.h"
#include "core/io/meshes/ply_writer.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstring>

namespace ramus::io {

namespace {

constexpr std::string_view kHeader = "# ramus " RAMUS_VERSION ", mm, RAS\n";

// Lines of the file, put together without the locale.
class Lines {
public:
    explicit Lines(OutputFile& file) : file_(file) {}

    void vector(std::string_view name, const glm::vec3& vector) {
        text(name);
        for (int axis = 0; axis < 3; ++axis) {
            text(" ");
            number(vector[axis]);
        }
        end();
    }
    void face(const glm::uvec3& triangle, bool with_normals) {
        text("f");
        for (int corner = 0; corner < 3; ++corner) {
            const std::uint64_t index = std::uint64_t{triangle[corner]} + 1;
            text(" ");
            number(index);
            if (!with_normals) continue;
            text("//");
            number(index);
        }
        end();
    }

private:
    void text(std::string_view word) { next_ = std::ranges::copy(word, next_).out; }
    template <class T> void number(T value) { next_ = std::to_chars(next_, bytes_.data() + bytes_.size(), value).ptr; }
    void end() {
        *next_++ = '\n';
        file_.write(bytes_.data(), static_cast<std::size_t>(next_ - bytes_.data()));
        next_ = bytes_.data();
    }

    OutputFile& file_;
    std::array<char, 128> bytes_; // three pairs of 10-digit indices, or three floats, and what stands between them
    char* next_ = bytes_.data();
};

// Calls write(record) for every record of `Size` bytes.
template <std::size_t Size, class Write> void for_records(TemporaryFile& file, const Write& write) {
    constexpr std::size_t kAtOnce = 16384;
    std::vector<std::byte> records(kAtOnce * Size);
    for (std::uint64_t at = 0; at < file.size(); at += records.size()) {
        const std::uint64_t bytes = std::min<std::uint64_t>(records.size(), file.size() - at);
        file.read(at, records.data(), bytes);
        for (std::uint64_t n = 0; n < bytes; n += Size) write(records.data() + n);
    }
}

} // namespace

Result<PolygonSoup> parse_obj(std::string_view text, const std::string& name) {
    return parse_with_assimp(text, "obj", name);
}

void write_obj(const mesh::TriangleMesh& mesh, OutputFile& file) {
    file.write(kHeader);
    Lines lines(file);
    for (const glm::vec3& position : mesh.positions) lines.vector("v", position);
    for (const glm::vec3& normal : mesh.normals) lines.vector("vn", normal);
    for (const glm::uvec3& triangle : mesh.triangles) lines.face(triangle, !mesh.normals.empty());
}

void keep_obj_vertices(const mesh::VertexSpan& more, MeshParts& parts) { keep_ply_vertices(more, parts); }

void keep_obj_triangles(std::span<const glm::uvec3> more, const mesh::VertexSpan& /*vertices*/, MeshParts& parts) {
    parts.triangles.write(more.data(), more.size_bytes());
}

void write_obj_parts(MeshParts& parts, OutputFile& file) {
    file.write(kHeader);
    Lines lines(file);
    const auto write_vectors = [&](std::string_view name, std::size_t index) {
        for_records<kPlyVertex>(parts.vertices, [&](const std::byte* vertex) {
            glm::vec3 vector;
            std::memcpy(&vector, vertex + index * sizeof vector, sizeof vector);
            lines.vector(name, vector);
        });
    };
    write_vectors("v", 0);
    write_vectors("vn", 1);
    for_records<sizeof(glm::uvec3)>(parts.triangles, [&](const std::byte* corners) {
        glm::uvec3 triangle;
        std::memcpy(&triangle, corners, sizeof triangle);
        lines.face(triangle, true);
    });
}

} // namespace ramus::io
