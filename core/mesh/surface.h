// From a vessel tree to its surface: the one way for commands, the window's first surface, comparisons and validation.
// A surface that follows which branches are hidden is in followed_surface.h; both are made of the same fields
// (tree_field.h).
#pragma once

#include "core/base/error.h"
#include "core/base/job.h"
#include "core/mesh/loops/match_tree.h"
#include "core/mesh/polygonize/part.h"
#include "core/mesh/surface_options.h"
#include "core/mesh/untangle/untangle.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>

namespace ramus {
class DiskPages;
} // namespace ramus

namespace ramus::field {
class SurfaceProjector;
} // namespace ramus::field

namespace ramus::mesh {

// What a surface cost: for `--json`, `--verbose` and the benchmarks.
struct SurfaceStatistics {
    std::uint64_t evaluations = 0; // kernel evaluations, one per segment and point
    double seconds = 0.0;
    MatchedTree matched;
    Untangled untangled; // where it was asked for
    PartStatistics part; // of the part that this process made, if it did not make all
};

struct Surface {
    TriangleMesh mesh;
    std::shared_ptr<const DiskPages> disk; // where its arrays are; null: in memory
    // What it is a mesh of, where it is for pictures; else null.
    std::shared_ptr<const field::SurfaceProjector> projector;
    SurfaceStatistics statistics;
};

// Surface of `source` under `options`, closed where hidden branches were, with the loops of what is visible where
// vessels blend along the tree; vertex branch ids are those of `source`. Of several systems each has a surface of its
// own, one after the other (core/mesh/systems.h). Fails when the options cannot be met (more triangles than memory
// holds, a kernel that does not take the width), when every branch is hidden, when nothing has a surface, or when `job`
// is cancelled (what == "cancelled").
[[nodiscard]] Result<Surface> make_surface(const tree::VesselTree& source, const SurfaceOptions& options, Job& job,
                                           std::span<const std::uint8_t> hidden = {});
// The same for files, which simulations and printers read: where it goes through itself within a few triangles, their
// vertices are moved (core/mesh/untangle). Takes some more time, and makes no difference that can be seen. Fails if a
// convolution surface is not closed (edge_balance.h). `target`: the file; may be empty. What does not fit into memory
// is on its disk (core/base/disk_pages.h), so that the surface has the same bits whatever memory it may take, or making
// it fails.
[[nodiscard]] Result<Surface> make_untangled_surface(const tree::VesselTree& source, const SurfaceOptions& options,
                                                     Job& job, std::span<const std::uint8_t> hidden = {},
                                                     const std::filesystem::path& target = {});
// The same by a team, to the same bits: all polygonize it, the leader repairs it. Empty for the others.
[[nodiscard]] Result<Surface> make_surface_together(const tree::VesselTree& source, const SurfaceOptions& options,
                                                    Team& team, Job& job, std::span<const std::uint8_t> hidden,
                                                    const std::filesystem::path& target);
// One part of the same, with a border. Nothing is repaired, because loops may run through several parts. May be empty.
[[nodiscard]] Result<Surface> make_part_of_surface(const tree::VesselTree& source, const SurfaceOptions& options,
                                                   const PartOf& part, Job& job, std::span<const std::uint8_t> hidden,
                                                   const std::filesystem::path& target);

// The error of a surface that has no triangle.
[[nodiscard]] tl::unexpected<Error> empty_surface(double cell_mm);

} // namespace ramus::mesh
