#include "core/io/meshes/surface_file.h"

#include "core/io/meshes/mesh_file.h"

#include <algorithm>
#include <utility>

namespace ramus::io {

namespace {

// Calls write(block) for all that is in the file, some at a time.
template <class T, class Write> void for_blocks(TemporaryFile& file, const Write& write) {
    std::vector<T> block(16384);
    for (std::uint64_t at = 0; at < file.size(); at += block.size() * sizeof(T)) {
        const auto count = std::min<std::size_t>(block.size(), (file.size() - at) / sizeof(T));
        file.read(at, block.data(), count * sizeof(T));
        write(std::span<const T>(block.data(), count));
    }
}

} // namespace

Result<std::unique_ptr<SurfaceFile>> SurfaceFile::create(const std::filesystem::path& path,
                                                         const tree::Claims& claims) {
    RAMUS_TRY(format, mesh_format(path));
    if (!is_streamed(*format))
        return fail("the surface is larger than memory, and this format cannot be written in parts", path.string(),
                    "use " + streamed_mesh_extensions() + ", a lower --detail, or more --memory");
    if (auto possible = check_output(path); !possible) return tl::unexpected(possible.error());
    std::vector<TemporaryFile> parts;
    while (parts.size() <= format->vertices.size()) {
        RAMUS_TRY(part, TemporaryFile::create(path));
        parts.push_back(std::move(part));
    }
    return std::unique_ptr<SurfaceFile>(new SurfaceFile(path, *format, std::move(parts), claims));
}

SurfaceFile::SurfaceFile(std::filesystem::path path, const MeshFormat& format, std::vector<TemporaryFile> parts,
                         const tree::Claims& claims)
    : path_(std::move(path)), format_(format), parts_(std::move(parts)) {
    counts_.claims = claims;
}

bool SurfaceFile::add_vertices(const mesh::VertexSpan& more) {
    counts_.vertices += more.size();
    if (format_.is_text) {
        parts_[0].write(more.positions.data(), more.positions.size_bytes());
        parts_[1].write(more.normals.data(), more.normals.size_bytes());
    } else {
        for (std::size_t i = 0; i < format_.vertices.size(); ++i)
            if (format_.vertices[i] != nullptr) format_.vertices[i](more, parts_[i]);
    }
    return check().has_value();
}

bool SurfaceFile::add_triangles(std::span<const glm::uvec3> more, const mesh::VertexSpan& vertices) {
    counts_.triangles += more.size();
    if (format_.is_text)
        parts_.back().write(more.data(), more.size_bytes());
    else
        format_.triangles(more, vertices, parts_.back());
    return check().has_value();
}

Result<void> SurfaceFile::check() const {
    if (counts_.vertices > kMostInFile || counts_.triangles > kMostInFile) return too_many_for_file(path_);
    for (const TemporaryFile& part : parts_)
        if (auto kept = part.check(); !kept) return kept;
    return {};
}

void SurfaceFile::write_text(OutputFile& file) {
    for_blocks<glm::vec3>(parts_[0], [&](auto positions) { format_.vertices[0]({positions, {}, {}, {}}, file); });
    for_blocks<glm::vec3>(parts_[1], [&](auto normals) { format_.vertices[1]({{}, normals, {}, {}}, file); });
    const glm::vec3 any(0.0F);
    const mesh::VertexSpan with_normals{{}, {&any, 1}, {}, {}};
    for_blocks<glm::uvec3>(parts_.back(), [&](auto triangles) { format_.triangles(triangles, with_normals, file); });
}

Result<void> SurfaceFile::commit() {
    if (auto taken = check(); !taken) return taken;
    RAMUS_TRY(file, OutputFile::create(path_));
    file.write(format_.header(counts_));
    if (format_.is_text)
        write_text(file);
    else
        for (TemporaryFile& part : parts_) part.copy_to(file);
    if (auto read = check(); !read) return read;
    return file.commit();
}

} // namespace ramus::io
