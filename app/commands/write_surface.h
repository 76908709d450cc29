// A tree's surface, made and written: in memory, or on the disk when it is more than memory holds. The file is the same
// either way.
#pragma once

#include "core/base/error.h"
#include "core/io/meshes/mesh_names.h"
#include "core/measure/wall_thickness.h"
#include "core/mesh/connectivity.h"
#include "core/mesh/surface.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <vector>

namespace ramus::app {

struct WrittenSurface {
    std::uint64_t vertices = 0, triangles = 0, evaluations = 0;
    mesh::Connectivity shape; // loops: where it is closed
    // Of the tree's branches that are on a closed surface of it: what that has to be like.
    std::optional<mesh::Connectivity> tree_shape;
    // What was done to have the tree's pieces and loops, and pairs of triangles that met; none: not looked for, which
    // is not that there is none. Nor is it where not all pairs were looked at.
    std::optional<mesh::MatchedTree> matched;
    std::optional<mesh::Untangled> untangled;
    bool streamed = false;                     // made on the disk
    std::vector<std::vector<int>> lost_pieces; // of the tree, by branch: not on the surface (core/mesh/lost_pieces.h)
    double mesh_s = 0.0, write_s = 0.0;
    std::vector<measure::Thickness> thicknesses; // for printing: as measure::least_thicknesses() gives them
};

struct SurfaceTarget {
    std::filesystem::path file;
    io::MeshNames names;       // for formats that have a place for them
    bool for_printing = false; // then the surface has to be closed, and its thickness is measured
    int threads = 0;
};

// Writes a surface that is there: adds to `written` what it consists of and how long writing took. Fails on what cannot
// be written or is not fit for printing.
[[nodiscard]] Result<void> write_surface(mesh::TriangleMesh surface, const SurfaceTarget& target,
                                         WrittenSurface& written);

// Shows a progress bar; an interrupt cancels it.
[[nodiscard]] Result<WrittenSurface> write_surface(const tree::VesselTree& tree, const mesh::SurfaceOptions& options,
                                                   std::span<const std::uint8_t> hidden, const SurfaceTarget& target);

} // namespace ramus::app
