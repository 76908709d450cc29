#include "core/io/surface_file.h"

#include "core/io/mesh_encoding.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace ramus::io {

namespace {

// Calls write(record) for every record of `Size` bytes.
template <std::size_t Size, class Write> void for_records(Spool& spool, const Write& write) {
    constexpr std::size_t kAtOnce = 16384;
    std::vector<std::byte> records(kAtOnce * Size);
    for (std::uint64_t at = 0; at < spool.size(); at += records.size()) {
        const std::uint64_t bytes = std::min<std::uint64_t>(records.size(), spool.size() - at);
        spool.read(at, records.data(), bytes);
        for (std::uint64_t n = 0; n < bytes; n += Size) write(records.data() + n);
    }
}

} // namespace

Result<std::unique_ptr<SurfaceFile>> SurfaceFile::create(const std::filesystem::path& path) {
    const auto format = mesh_format(path);
    if (!format) return tl::unexpected(format.error());
    if (auto possible = check_output(path); !possible) return tl::unexpected(possible.error());
    auto vertices = Spool::create(path);
    if (!vertices) return tl::unexpected(vertices.error());
    auto triangles = Spool::create(path);
    if (!triangles) return tl::unexpected(triangles.error());
    return std::unique_ptr<SurfaceFile>(new SurfaceFile(path, *format, std::move(*vertices), std::move(*triangles)));
}

SurfaceFile::SurfaceFile(std::filesystem::path path, MeshFormat format, Spool vertices, Spool triangles)
    : path_(std::move(path)), format_(format), vertices_(std::move(vertices)), triangles_(std::move(triangles)) {}

bool SurfaceFile::add_vertices(const mesh::VertexSpan& more) {
    vertex_count_ += more.size();
    if (format_ != MeshFormat::kStl) write_ply_vertices(more, vertices_);
    return check().has_value();
}

bool SurfaceFile::add_triangles(std::span<const glm::uvec3> more, const mesh::VertexSpan& vertices) {
    triangle_count_ += more.size();
    switch (format_) {
    case MeshFormat::kPly:
        for (const glm::uvec3& t : more) ply_face(t).write(triangles_);
        break;
    case MeshFormat::kStl:
        for (const glm::uvec3& t : more)
            stl_facet(vertices.positions[t.x], vertices.positions[t.y], vertices.positions[t.z]).write(triangles_);
        break;
    case MeshFormat::kObj:
        triangles_.write(more.data(), more.size_bytes());
        break;
    }
    return check().has_value();
}

Result<void> SurfaceFile::check() const {
    if (vertex_count_ > kMostInFile || triangle_count_ > kMostInFile) return too_many_for_file(path_.string());
    if (auto written = vertices_.check(); !written) return written;
    return triangles_.check();
}

Result<void> SurfaceFile::commit() {
    if (auto taken = check(); !taken) return taken;
    auto file = OutputFile::create(path_);
    if (!file) return tl::unexpected(file.error());
    write_whole(*file);
    if (auto read = check(); !read) return read;
    return file->commit();
}

void SurfaceFile::write_whole(OutputFile& file) {
    switch (format_) {
    case MeshFormat::kPly:
        file.write(ply_header({}, vertex_count_, triangle_count_));
        vertices_.copy_to(file);
        triangles_.copy_to(file);
        break;
    case MeshFormat::kStl:
        file.write(stl_header(triangle_count_));
        triangles_.copy_to(file);
        break;
    case MeshFormat::kObj:
        file.write(obj_header());
        ObjLines lines(file);
        const auto vectors = [&](std::string_view name, std::size_t place) {
            for_records<kPlyVertex>(vertices_, [&](const std::byte* vertex) {
                glm::vec3 vector;
                std::memcpy(&vector, vertex + place * sizeof vector, sizeof vector);
                lines.vector(name, vector);
            });
        };
        vectors("v", 0);
        vectors("vn", 1);
        for_records<sizeof(glm::uvec3)>(triangles_, [&](const std::byte* corners) {
            glm::uvec3 triangle;
            std::memcpy(&triangle, corners, sizeof triangle);
            lines.face(triangle, true);
        });
        break;
    }
}

} // namespace ramus::io
