// SurfaceFile: a surface written to a file part by part, so that it need never be in memory as a whole. Parts wait on
// the disk, in files without a name, until all are there: as much again as the file itself takes. What comes out is, to
// the byte, what write_mesh() makes of the whole mesh.
#pragma once

#include "core/io/mesh_writer.h"
#include "core/io/output_file.h"
#include "core/io/spool.h"
#include "core/mesh/surface_sink.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace ramus::io {

class SurfaceFile final : public mesh::SurfaceSink {
public:
    [[nodiscard]] static Result<std::unique_ptr<SurfaceFile>> create(const std::filesystem::path& path);

    [[nodiscard]] bool add_vertices(const mesh::VertexSpan& vertices) override;
    [[nodiscard]] bool add_triangles(const mesh::TrianglePart& part) override;

    // What kept it from taking more, if anything.
    [[nodiscard]] Result<void> check() const;
    // Puts the file together and in its place. The end of it.
    [[nodiscard]] Result<void> commit();

    [[nodiscard]] std::uint64_t vertex_count() const { return vertex_count_ + added_count_; }
    [[nodiscard]] std::uint64_t triangle_count() const { return triangle_count_; }

private:
    struct Part {
        std::uint64_t offset = 0; // of its triangles, bytes
        std::uint32_t triangles = 0;
        std::uint32_t first_added = 0, added = 0;
    };

    SurfaceFile(std::filesystem::path path, MeshFormat format, Spool vertices, Spool triangles);
    void write_whole(OutputFile& file);
    template <class Write> void for_vertices(const Write& write);
    template <class Write> void for_triangles(const Write& write);

    std::filesystem::path path_;
    MeshFormat format_;
    Spool vertices_;  // records as in a PLY file; none for STL
    Spool triangles_; // corners as they came; facets for STL
    std::vector<Part> parts_;
    std::vector<std::byte> added_; // vertices of parts alone, as they came: they are few
    std::uint64_t vertex_count_ = 0, added_count_ = 0, triangle_count_ = 0;
};

} // namespace ramus::io
