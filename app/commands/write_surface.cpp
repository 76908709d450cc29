#include "app/commands/write_surface.h"

#include "app/commands/progress.h"
#include "core/base/stopwatch.h"
#include "core/io/meshes/mesh_file.h"
#include "core/io/meshes/surface_file.h"
#include "core/mesh/close_mesh.h"
#include "core/mesh/lost_pieces.h"
#include "core/validate/shape.h"

namespace ramus::app {

namespace {

// Counts the pieces and loops of what passes through to the file.
class CountingSink final : public mesh::SurfaceSink {
public:
    CountingSink(io::SurfaceFile& file, std::size_t branches) : file_(file), seen_(branches) {}

    [[nodiscard]] bool add_vertices(const mesh::VertexSpan& more) override {
        count_.add_vertices(more.size());
        seen_.add(more.branches);
        return file_.add_vertices(more);
    }
    [[nodiscard]] bool add_triangles(std::span<const glm::uvec3> more, const mesh::VertexSpan& vertices) override {
        count_.add_triangles(more);
        return file_.add_triangles(more, vertices);
    }
    [[nodiscard]] mesh::Connectivity shape() const { return count_.connectivity(); }
    [[nodiscard]] const mesh::SeenBranches& seen() const { return seen_; }

private:
    io::SurfaceFile& file_;
    mesh::SeenBranches seen_;
    mesh::ConnectivityCount count_;
};

// Cones are no closed surface.
void compare_shapes(const tree::VesselTree& tree, const mesh::SurfaceOptions& options,
                    std::span<const std::uint8_t> hidden, WrittenSurface& written) {
    if (options.method != mesh::Method::kConvolutionSurface) return;
    mesh::Connectivity all = validate::expected_shape(tree, hidden);
    all.pieces -= static_cast<std::int64_t>(written.lost_pieces.size());
    written.tree_shape = all;
}

Result<WrittenSurface> write_streamed(const tree::VesselTree& tree, const mesh::SurfaceOptions& options,
                                      std::span<const std::uint8_t> hidden, const std::filesystem::path& output) {
    Stopwatch watch;
    RAMUS_TRY(file, io::SurfaceFile::create(output, tree.claims));
    CountingSink sink(*file, tree.branches.size());
    const auto stream = [&](Job& job) { return mesh::stream_surface(tree, options, sink, job, hidden); };
    const auto streamed = with_progress("surface", stream, kNothingWritten);
    if (auto taken = file->check(); !taken) return tl::unexpected(taken.error());
    if (!streamed) return tl::unexpected(streamed.error());
    WrittenSurface written;
    written.vertices = file->vertex_count();
    written.triangles = file->triangle_count();
    written.evaluations = streamed->evaluations;
    written.shape = sink.shape();
    written.lost_pieces = mesh::lost_pieces(tree, hidden, sink.seen());
    compare_shapes(tree, options, hidden, written);
    written.streamed = true;
    written.mesh_s = watch.lap();
    if (auto committed = file->commit(); !committed) return tl::unexpected(committed.error());
    written.write_s = watch.lap();
    return written;
}

} // namespace

Result<void> write_surface(const mesh::TriangleMesh& surface, const SurfaceTarget& target, WrittenSurface& written) {
    Stopwatch watch;
    written.vertices = surface.positions.size();
    written.triangles = surface.triangles.size();
    if (target.for_printing) {
        if (auto closed = mesh::check_closed(surface, target.file.string()); !closed) return closed;
        written.thicknesses = measure::least_thicknesses(surface, target.threads);
    }
    written.shape = mesh::connectivity_of(surface);
    written.mesh_s += watch.lap();
    if (auto saved = io::write_mesh(surface, target.file, target.names); !saved) return saved;
    written.write_s = watch.lap();
    return {};
}

Result<WrittenSurface> write_surface(const tree::VesselTree& tree, const mesh::SurfaceOptions& options,
                                     std::span<const std::uint8_t> hidden, const SurfaceTarget& target) {
    if (mesh::asks_for_streaming(tree, options, hidden)) {
        if (target.for_printing)
            return fail("the surface is larger than memory, and cannot be measured for printing", target.file.string(),
                        "use a lower --detail or more --memory");
        return write_streamed(tree, options, hidden, target.file);
    }
    Stopwatch watch;
    const auto make = [&](Job& job) { return mesh::make_untangled_surface(tree, options, job, hidden); };
    RAMUS_TRY(surface, with_progress("surface", make, kNothingWritten));
    WrittenSurface written;
    written.evaluations = surface.statistics.evaluations;
    if (options.method == mesh::Method::kConvolutionSurface) {
        if (options.blend == mesh::Blend::kTree) written.matched = surface.statistics.matched;
        written.untangled = surface.statistics.untangled;
    }
    mesh::SeenBranches seen(tree.branches.size());
    seen.add(surface.mesh.branches);
    written.lost_pieces = mesh::lost_pieces(tree, hidden, seen);
    compare_shapes(tree, options, hidden, written);
    written.mesh_s = watch.lap();
    if (auto saved = write_surface(surface.mesh, target, written); !saved) return tl::unexpected(saved.error());
    return written;
}

} // namespace ramus::app
