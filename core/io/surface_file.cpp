#include "core/io/surface_file.h"

#include "core/io/mesh_encoding.h"

#include <algorithm>
#include <utility>

namespace ramus::io {

namespace {

// Where records go that stay in memory.
struct Bytes {
    std::vector<std::byte>& bytes;
    void write(const std::byte* from, std::size_t count) { bytes.insert(bytes.end(), from, from + count); }
};

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

bool SurfaceFile::add_vertices(const mesh::VertexSpan& vertices) {
    vertex_count_ += vertices.size();
    if (format_ != MeshFormat::kStl) write_ply_vertices(vertices, vertices_);
    return check().has_value();
}

bool SurfaceFile::add_triangles(const mesh::TrianglePart& part) {
    if (parts_.size() <= part.part) parts_.resize(part.part + 1);
    parts_[part.part] = {triangles_.size(), static_cast<std::uint32_t>(part.triangles.size()),
                         static_cast<std::uint32_t>(added_count_), static_cast<std::uint32_t>(part.added.size())};
    triangle_count_ += part.triangles.size();
    added_count_ += part.added.size();
    if (format_ == MeshFormat::kStl) {
        for (const glm::uvec3& t : part.triangles)
            stl_facet(part.position(t.x), part.position(t.y), part.position(t.z)).write(triangles_);
    } else {
        Bytes added{added_};
        write_ply_vertices(part.added, added);
        triangles_.write(part.triangles.data(), part.triangles.size_bytes());
    }
    return check().has_value();
}

Result<void> SurfaceFile::check() const {
    if (vertex_count() > kMostInFile || triangle_count() > kMostInFile) return too_many_for_file(path_.string());
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
        file.write(ply_header({}, vertex_count(), triangle_count()));
        for_vertices([&](const std::byte* vertex) { file.write(vertex, kPlyVertex); });
        for_triangles([&](const glm::uvec3& triangle) { write_ply_face(triangle, file); });
        break;
    case MeshFormat::kStl: {
        file.write(stl_header(triangle_count()));
        std::vector<std::byte> facets;
        for (const Part& part : parts_) {
            facets.resize(part.triangles * kStlFacet);
            triangles_.read(part.offset, facets.data(), facets.size());
            file.write(facets.data(), facets.size());
        }
        break;
    }
    case MeshFormat::kObj:
        file.write(obj_header());
        ObjLines lines(file);
        const auto vectors = [&](std::string_view name, std::size_t place) {
            for_vertices([&](const std::byte* vertex) {
                glm::vec3 vector;
                std::memcpy(&vector, vertex + place * sizeof vector, sizeof vector);
                lines.vector(name, vector);
            });
        };
        vectors("v", 0);
        vectors("vn", 1);
        for_triangles([&](const glm::uvec3& triangle) { lines.face(triangle, true); });
        break;
    }
}

// The vertices' records in the mesh's order: first all parts' own, then those that parts added.
template <class Write> void SurfaceFile::for_vertices(const Write& write) {
    constexpr std::size_t kAtOnce = 4096;
    std::vector<std::byte> records(kAtOnce * kPlyVertex);
    for (std::uint64_t v = 0; v < vertex_count_; v += kAtOnce) {
        const std::uint64_t count = std::min<std::uint64_t>(kAtOnce, vertex_count_ - v);
        vertices_.read(v * kPlyVertex, records.data(), count * kPlyVertex);
        for (std::uint64_t n = 0; n < count; ++n) write(records.data() + n * kPlyVertex);
    }
    for (const Part& part : parts_)
        for (std::uint32_t n = part.first_added; n < part.first_added + part.added; ++n)
            write(added_.data() + n * kPlyVertex);
}

// The triangles in the mesh's order, by the vertices' places in it.
template <class Write> void SurfaceFile::for_triangles(const Write& write) {
    constexpr std::uint32_t kAddedBit = mesh::TrianglePart::kAddedBit;
    auto first_added = static_cast<std::uint32_t>(vertex_count_);
    std::vector<glm::uvec3> triangles;
    for (const Part& part : parts_) {
        triangles.resize(part.triangles);
        triangles_.read(part.offset, triangles.data(), triangles.size() * sizeof(glm::uvec3));
        for (glm::uvec3& triangle : triangles) {
            for (int corner = 0; corner < 3; ++corner)
                if ((triangle[corner] & kAddedBit) != 0)
                    triangle[corner] = first_added + (triangle[corner] & ~kAddedBit);
            write(triangle);
        }
        first_added += part.added;
    }
}

} // namespace ramus::io
