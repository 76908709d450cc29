#include "app/commands/write_surface.h"

#include "app/commands/progress.h"
#include "core/base/stopwatch.h"
#include "core/io/meshes/mesh_file.h"
#include "core/mesh/close_mesh.h"
#include "core/mesh/lost_pieces.h"
#include "core/validate/shape.h"

#include <utility>

namespace ramus::app {

namespace {

// Sets the pieces and loops that the surface should have. Truncated cones are not one closed surface.
void compare_shapes(const tree::VesselTree& tree, const mesh::SurfaceOptions& options,
                    std::span<const std::uint8_t> hidden, WrittenSurface& written) {
    if (options.method != mesh::Method::kConvolutionSurface) return;
    mesh::Connectivity all = validate::expected_shape(tree, hidden);
    all.pieces -= static_cast<std::int64_t>(written.lost_pieces.size());
    written.tree_shape = all;
}

} // namespace

Result<void> write_surface(mesh::TriangleMesh surface, const SurfaceTarget& target, WrittenSurface& written) {
    Stopwatch watch;
    written.vertices = surface.positions.size();
    written.triangles = surface.triangles.size();
    if (target.for_printing) {
        if (auto closed = mesh::check_closed(surface, target.file.string()); !closed) return closed;
        written.thicknesses = measure::least_thicknesses(surface, target.threads);
    }
    written.shape = mesh::connectivity_of(surface);
    written.mesh_s += watch.lap();
    if (auto saved = io::write_mesh(std::move(surface), target.file, target.names); !saved) return saved;
    written.write_s = watch.lap();
    return {};
}

Result<WrittenSurface> write_surface(const tree::VesselTree& tree, const mesh::SurfaceOptions& options,
                                     std::span<const std::uint8_t> hidden, const SurfaceTarget& target,
                                     const MadeBy& by) {
    Stopwatch watch;
    const auto make = [&](Job& job) {
        if (by.part) return mesh::make_part_of_surface(tree, options, *by.part, job, hidden, target.file);
        if (by.team != nullptr) return mesh::make_surface_together(tree, options, *by.team, job, hidden, target.file);
        return mesh::make_untangled_surface(tree, options, job, hidden, target.file);
    };
    RAMUS_TRY(surface, with_progress("surface", make, kNothingWritten));
    WrittenSurface written;
    written.evaluations = surface.statistics.evaluations;
    written.part = surface.statistics.part;
    if (by.team != nullptr && !by.team->leads()) return written;
    written.streamed = surface.disk != nullptr;
    if (by.part) {
        written.mesh_s = watch.lap();
        if (auto saved = write_surface(std::move(surface.mesh), target, written); !saved)
            return tl::unexpected(saved.error());
        return written;
    }
    if (options.method == mesh::Method::kConvolutionSurface) {
        if (mesh::row_of(options.blend).separates) written.matched = surface.statistics.matched;
        written.untangled = surface.statistics.untangled;
    }
    mesh::SeenBranches seen(tree.branches.size());
    seen.add(surface.mesh.branches);
    written.lost_pieces = mesh::lost_pieces(tree, hidden, seen);
    compare_shapes(tree, options, hidden, written);
    written.mesh_s = watch.lap();
    if (auto saved = write_surface(std::move(surface.mesh), target, written); !saved)
        return tl::unexpected(saved.error());
    return written;
}

} // namespace ramus::app
