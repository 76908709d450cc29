// SurfaceFile: a surface written to a file as it is made, so that it need never be in memory as a whole. What has come
// waits on the disk, in temporary files, until all is there: about as much again as the file itself takes. What comes
// out is, to the byte, what write_mesh() makes of the whole mesh.
#pragma once

#include "core/io/meshes/mesh_file.h"
#include "core/io/output_file.h"
#include "core/io/temporary_file.h"
#include "core/mesh/surface_sink.h"

#include <memory>

namespace ramus::io {

class SurfaceFile final : public mesh::SurfaceSink {
public:
    [[nodiscard]] static Result<std::unique_ptr<SurfaceFile>> create(const std::filesystem::path& path,
                                                                     const tree::Claims& claims = {});

    [[nodiscard]] bool add_vertices(const mesh::VertexSpan& more) override;
    [[nodiscard]] bool add_triangles(std::span<const glm::uvec3> more, const mesh::VertexSpan& vertices) override;

    // What kept it from taking more, if anything.
    [[nodiscard]] Result<void> check() const;
    // Puts the file together and in its place. Nothing can be added afterwards.
    [[nodiscard]] Result<void> commit();

    [[nodiscard]] std::uint64_t vertex_count() const { return counts_.vertices; }
    [[nodiscard]] std::uint64_t triangle_count() const { return counts_.triangles; }

private:
    void write_text(OutputFile& file);
    SurfaceFile(std::filesystem::path path, const MeshFormat& format, std::vector<TemporaryFile> parts,
                const tree::Claims& claims);

    std::filesystem::path path_;
    const MeshFormat& format_;
    std::vector<TemporaryFile> parts_; // one for each of the format's `vertices`, and that of the triangles
    MeshCounts counts_;
};

} // namespace ramus::io
