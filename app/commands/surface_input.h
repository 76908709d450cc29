// Loads the surfaces that a command line names: a mesh is read, the surface of a tree or the isosurface of a mask is
// computed. Coordinates are in mm, RAS.
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

// A surface and what is known of its source.
struct SurfaceInput {
    mesh::TriangleMesh mesh;
    tree::Claims claims;                 // of the tree, mask or mesh; the unit of meshes is assumed to be mm
    bool is_mesh = false;                // read from a file of triangles
    std::string stated_axes = {};        // the axes that the mesh file states, "LPS"; empty: none
    std::optional<double> half_voxel_mm; // half the diagonal of a voxel; only for masks
};

// The voxels of a mask that are inside the vessels.
struct MaskVoxels {
    volume::BitMask inside{glm::ivec3(0)};
    glm::dmat4 to_patient{1.0}; // voxel indices to mm, RAS
};

// What the command line states about masks.
struct MaskInput {
    std::vector<volume::LabelChoice> labels; // --label; empty: all
    std::string units;                       // --mask-units; empty: as the file says
};

// The flags for reading a mask: `flags`, with the unit of `mask` if it has one.
[[nodiscard]] SurfaceFlags with_units(SurfaceFlags flags, const MaskInput& mask);

// The kinds of files that load_surface() accepts, with their extensions, for help texts and messages.
[[nodiscard]] std::string surface_input_kinds();

// Loads a surface of any kind, by the extension of `file`. Shows a progress bar; an interrupt cancels. Meshes may have
// holes. `mesh_axes`: see load_mesh().
[[nodiscard]] Result<SurfaceInput> load_surface(const std::string& file, const SurfaceFlags& flags,
                                                const MaskInput& mask, const std::string& mesh_axes);
// Reads a mesh. `axes`: "LPS" or "RAS", for a mesh that does not state its axes; empty: not given.
[[nodiscard]] Result<SurfaceInput> load_mesh(const std::string& file, const std::string& axes);
// Warns on standard error if the axes `asked` for on the command line differ from those that the mesh file states.
void warn_of_stated_axes(const std::string& file, const SurfaceInput& mesh, const std::string& asked);
// Warns on standard error if a mesh is rotated by half a turn against `vessels`, since its axes were read as LPS
// instead of RAS or the reverse (app/assets/half_turn.h). `option`: the option to suggest, such as
// "--mesh-orientation LPS".
void warn_of_half_turn(const std::string& file, const SurfaceInput& mesh, const Place& vessels,
                       const std::string& option);
// Computes the isosurface of a mask. `voxels`: receives the voxels of the mask, unless null.
[[nodiscard]] Result<SurfaceInput> surface_of_mask(const std::string& file, const SurfaceFlags& flags,
                                                   const MaskInput& mask, MaskVoxels* voxels = nullptr);
// Computes the surface of a tree with the options of `flags`.
[[nodiscard]] Result<SurfaceInput> surface_of_tree(const tree::VesselTree& tree, const SurfaceFlags& flags);

} // namespace ramus::app
