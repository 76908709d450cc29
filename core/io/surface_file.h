// SurfaceFile: a surface written to a file as it is made, so that it need never be in memory as a whole. What has come
// waits on the disk, in files without a name, until all is there: about as much again as the file itself takes. What
// comes out is, to the byte, what write_mesh() makes of the whole mesh.
#pragma once

#include "core/io/mesh_writer.h"
#include "core/io/output_file.h"
#include "core/io/spool.h"
#include "core/mesh/surface_sink.h"

#include <cstdint>
#include <memory>

namespace ramus::io {

class SurfaceFile final : public mesh::SurfaceSink {
public:
    [[nodiscard]] static Result<std::unique_ptr<SurfaceFile>> create(const std::filesystem::path& path);

    [[nodiscard]] bool add_vertices(const mesh::VertexSpan& more) override;
    [[nodiscard]] bool add_triangles(std::span<const glm::uvec3> more, const mesh::VertexSpan& vertices) override;

    // What kept it from taking more, if anything.
    [[nodiscard]] Result<void> check() const;
    // Puts the file together and in its place. The end of it.
    [[nodiscard]] Result<void> commit();

    [[nodiscard]] std::uint64_t vertex_count() const { return vertex_count_; }
    [[nodiscard]] std::uint64_t triangle_count() const { return triangle_count_; }

private:
    SurfaceFile(std::filesystem::path path, MeshFormat format, Spool vertices, Spool triangles);
    void write_whole(OutputFile& file);

    std::filesystem::path path_;
    MeshFormat format_;
    // As in the file, but for OBJ, which has other places for them and is much longer: PLY's vertices, and corners.
    Spool vertices_, triangles_;
    std::uint64_t vertex_count_ = 0, triangle_count_ = 0;
};

} // namespace ramus::io
