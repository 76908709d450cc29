// Computes the surface of a tree and writes it to a file. If memory does not suffice, the surface is computed on the
// disk of the output; the file is the same.
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

// What was written.
struct WrittenSurface {
    std::uint64_t vertices = 0, triangles = 0, evaluations = 0;
    mesh::Connectivity shape; // of the surface; loops are valid for closed surfaces only
    // The pieces and loops that the surface should have; none for truncated cones.
    std::optional<mesh::Connectivity> tree_shape;
    // The repairs of pieces and loops, and of intersecting triangles; none: not looked for. If not all pairs of
    // triangles were checked (Untangled::looked_at_all), the count is not complete.
    std::optional<mesh::MatchedTree> matched;
    std::optional<mesh::Untangled> untangled;
    bool streamed = false;                     // computed on the disk
    std::vector<std::vector<int>> lost_pieces; // pieces of the tree without surface (core/mesh/lost_pieces.h): branches
    double mesh_s = 0.0, write_s = 0.0;        // seconds
    mesh::PartStatistics part;                 // of what this process made, if others made the rest
    std::vector<measure::Thickness> thicknesses; // for printing, from measure::least_thicknesses(); else empty
};

// Where and how a surface is written.
struct SurfaceTarget {
    std::filesystem::path file;
    io::MeshNames names;       // for formats that store names
    bool for_printing = false; // requires a closed surface, and measures its thickness
    int threads = 0;           // 0: one per core
};

// Writes a surface, and sets its counts, connectivity, thicknesses and times in `written`. Fails if the file cannot be
// written, or if the surface is to be printed and is not closed.
[[nodiscard]] Result<void> write_surface(mesh::TriangleMesh surface, const SurfaceTarget& target,
                                         WrittenSurface& written);

// Who makes the surface: this process, a team, or this process one part of it.
struct MadeBy {
    Team* team = nullptr;
    std::optional<mesh::PartOf> part = std::nullopt;
    [[nodiscard]] bool is_divided() const { return team != nullptr || part; }
};

// Computes and writes the surface of `tree`, or the part of it; the leader writes what a team made. `hidden`: by
// branch; not 0: the branch is left out. Shows a progress bar; an interrupt cancels.
[[nodiscard]] Result<WrittenSurface> write_surface(const tree::VesselTree& tree, const mesh::SurfaceOptions& options,
                                                   std::span<const std::uint8_t> hidden, const SurfaceTarget& target,
                                                   const MadeBy& by = {});

} // namespace ramus::app
