#include "app/commands/surface_input.h"

#include "app/commands/inputs.h"
#include "app/commands/progress.h"
#include "app/session/error_context.h"
#include "core/io/length_unit.h"
#include "core/io/meshes/mesh_file.h"
#include "core/io/volumes/volume_file.h"
#include "core/io/volumes/volume_unit.h"
#include "core/mesh/surface.h"
#include "core/volume/isosurface.h"

#include <filesystem>
#include <glm/geometric.hpp>
#include <iostream>
#include <system_error>
#include <utility>

namespace ramus::app {

SurfaceFlags with_units(SurfaceFlags flags, const MaskInput& mask) {
    if (!mask.units.empty()) flags.read.unit = io::length_unit(mask.units);
    return flags;
}

std::string surface_input_kinds() {
    return "a mesh (" + io::readable_mesh_extensions() + "), a vessel tree (" + io::readable_tree_extensions() +
           "), of which the surface is made, or a mask (" + io::readable_volume_extensions() +
           "), of which the isosurface is";
}

Result<SurfaceInput> load_mesh(const std::string& file, const std::string& axes) {
    RAMUS_TRY(read, io::read_mesh_file(file, {io::Holes::kAllowed, io::slicer_space(axes)}));
    SurfaceInput input;
    input.mesh = std::move(read.mesh);
    input.claims.orientation = read.axes;
    input.is_mesh = true;
    if (read.stated) input.stated_axes = read.stated->letters();
    return input;
}

void warn_of_stated_axes(const std::string& file, const SurfaceInput& mesh, const std::string& asked) {
    if (asked.empty() || mesh.stated_axes.empty() || mesh.stated_axes == asked) return;
    std::cerr << "ramus: " << file << ": the file states that its axes are " << mesh.stated_axes
              << "; --mesh-orientation is for meshes that state none\n";
}

void warn_of_half_turn(const std::string& file, const SurfaceInput& mesh, const Place& vessels,
                       const std::string& option) {
    const std::string hint = half_turn_hint({render::bounds_of(mesh.mesh), mesh.claims.orientation}, vessels, option);
    if (!hint.empty()) std::cerr << "ramus: " << file << ": " << hint << '\n';
}

Result<SurfaceInput> surface_of_mask(const std::string& file, const SurfaceFlags& flags, const MaskInput& mask,
                                     MaskVoxels* voxels) {
    const SurfaceFlags reading = with_units(flags, mask);
    RAMUS_TRY(volume, load_volume(file, reading));
    warn_about(file, volume);
    SurfaceInput made;
    made.claims = io::claims_of(volume, reading.read.unit);
    made.half_voxel_mm = 0.5 * glm::length(volume::spacing_mm(volume.to_patient));
    if (voxels != nullptr) {
        RAMUS_TRY(
            inside, with_progress("voxels", [&](Job& job) {
                return with_file(volume::inside(volume, {mask.labels, std::nullopt}, JobRange(job, 0.0F, 1.0F)), file);
            }));
        *voxels = {std::move(inside), volume.to_patient};
    }
    const volume::IsosurfaceOptions options{static_cast<double>(flags.surface.memory_bytes), flags.surface.threads};
    RAMUS_TRY(
        surface, with_progress("isosurface", [&](Job& job) {
            return with_file(volume::isosurface(std::move(volume), {mask.labels, std::nullopt}, options, job), file);
        }));
    made.mesh = std::move(surface);
    return made;
}

Result<SurfaceInput> surface_of_tree(const tree::VesselTree& tree, const SurfaceFlags& flags) {
    RAMUS_TRY(surface,
              with_progress("surface", [&](Job& job) { return mesh::make_surface(tree, flags.surface, job); }));
    SurfaceInput made;
    made.mesh = std::move(surface.mesh);
    made.claims = tree.claims;
    return made;
}

Result<SurfaceInput> load_surface(const std::string& file, const SurfaceFlags& flags, const MaskInput& mask,
                                  const std::string& mesh_axes) {
    if (io::is_mesh(file)) return load_mesh(file, mesh_axes);
    if (io::is_volume(file)) return surface_of_mask(file, flags, mask);
    auto tree = load_tree(file, flags);
    std::error_code missing;
    if (!tree && !io::names_tree(file) && std::filesystem::exists(file, missing))
        return fail(tree.error().what, tree.error().where, "give " + surface_input_kinds());
    if (!tree) return tl::unexpected(tree.error());
    return with_file(surface_of_tree(*tree, flags), file);
}

} // namespace ramus::app
