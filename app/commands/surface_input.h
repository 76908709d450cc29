// Surfaces that command lines name, read or made: a mesh, a tree's surface, the isosurface of a mask.
#pragma once

#include "app/assets/half_turn.h"
#include "app/commands/surface_flags.h"
#include "core/base/error.h"
#include "core/mesh/triangle_mesh.h"
#include "core/tree/vessel_tree.h"
#include "core/volume/bit_mask.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace ramus::app {

struct SurfaceInput {
    mesh::TriangleMesh mesh;
    tree::Claims claims;                 // of the tree, mask or mesh that it is of; meshes are taken as mm
    bool is_mesh = false;                // read from a file of triangles
    std::string stated_axes = {};        // by that file, "LPS"; empty: it states none
    std::optional<double> half_voxel_mm; // half the diagonal of the voxels of a mask; none of what has no voxels
};

struct MaskVoxels {
    volume::BitMask inside{glm::ivec3(0)};
    glm::dmat4 to_patient{1.0}; // of voxel indices, to mm, RAS
};

// What is said of masks beside their file.
struct MaskInput {
    std::vector<volume::LabelChoice> labels; // empty: all
    std::string units;                       // of lengths; empty: as the file says
};

// How a mask is read: as `flags` say, in the unit of `mask` where that has one.
[[nodiscard]] SurfaceFlags with_units(SurfaceFlags flags, const MaskInput& mask);

// "a mesh (.ply, ...), a mask (...) or a vessel tree"
[[nodiscard]] std::string surface_input_kinds();

// With a progress bar; an interrupt cancels. Meshes may have holes.
[[nodiscard]] Result<SurfaceInput> load_surface(const std::string& file, const SurfaceFlags& flags,
                                                const MaskInput& mask, const std::string& mesh_axes);
// Each of them alone. `axes`: "LPS" or "RAS", of a mesh that does not state them; empty: nobody says.
[[nodiscard]] Result<SurfaceInput> load_mesh(const std::string& file, const std::string& axes);
// Tells on standard error that the axes which were asked for are not those of a mesh that states others.
void warn_of_stated_axes(const std::string& file, const SurfaceInput& mesh, const std::string& asked);
// Warns on standard error of a mesh that lies half a turn from what it should lie on (app/assets/half_turn.h).
void warn_of_half_turn(const std::string& file, const SurfaceInput& mesh, const Place& vessels,
                       const std::string& option);
// `voxels`: takes the mask's, if not null.
[[nodiscard]] Result<SurfaceInput> surface_of_mask(const std::string& file, const SurfaceFlags& flags,
                                                   const MaskInput& mask, MaskVoxels* voxels = nullptr);
[[nodiscard]] Result<SurfaceInput> surface_of_tree(const tree::VesselTree& tree, const SurfaceFlags& flags);

} // namespace ramus::app
