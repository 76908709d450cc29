#include "core/io/meshes/surface_file.h"

#include "core/io/meshes/mesh_file.h"

#include <utility>

namespace ramus::io {

Result<std::unique_ptr<SurfaceFile>> SurfaceFile::create(const std::filesystem::path& path) {
    const auto format = mesh_format(path);
    if (!format) return tl::unexpected(format.error());
    if (auto possible = check_output(path); !possible) return tl::unexpected(possible.error());
    auto vertices = TemporaryFile::create(path);
    if (!vertices) return tl::unexpected(vertices.error());
    auto triangles = TemporaryFile::create(path);
    if (!triangles) return tl::unexpected(triangles.error());
    return std::unique_ptr<SurfaceFile>(
        new SurfaceFile(path, **format, MeshParts{std::move(*vertices), std::move(*triangles)}));
}

SurfaceFile::SurfaceFile(std::filesystem::path path, const MeshFormat& format, MeshParts parts)
    : path_(std::move(path)), format_(format), parts_(std::move(parts)) {}

bool SurfaceFile::add_vertices(const mesh::VertexSpan& more) {
    parts_.vertex_count += more.size();
    format_.keep_vertices(more, parts_);
    return check().has_value();
}

bool SurfaceFile::add_triangles(std::span<const glm::uvec3> more, const mesh::VertexSpan& vertices) {
    parts_.triangle_count += more.size();
    format_.keep_triangles(more, vertices, parts_);
    return check().has_value();
}

Result<void> SurfaceFile::check() const {
    if (parts_.vertex_count > kMostInFile || parts_.triangle_count > kMostInFile) return too_many_for_file(path_);
    if (auto written = parts_.vertices.check(); !written) return written;
    return parts_.triangles.check();
}

Result<void> SurfaceFile::commit() {
    if (auto taken = check(); !taken) return taken;
    auto file = OutputFile::create(path_);
    if (!file) return tl::unexpected(file.error());
    format_.write_parts(parts_, *file);
    if (auto read = check(); !read) return read;
    return file->commit();
}

} // namespace ramus::io
