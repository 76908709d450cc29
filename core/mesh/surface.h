// How a vessel tree becomes a surface, with the options that every command and the window share.
#pragma once

#include "core/base/error.h"
#include "core/base/job.h"
#include "core/field/kernels/kernel_kind.h"
#include "core/field/rims.h"
#include "core/mesh/blend.h"
#include "core/mesh/loops/match_tree.h"
#include "core/mesh/method.h"
#include "core/mesh/radii.h"
#include "core/mesh/untangle/untangle.h"
#include "core/tree/prepare.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>

namespace ramus {
class DiskPages;
} // namespace ramus

namespace ramus::field {
class SurfaceProjector;
class VesselField;
} // namespace ramus::field

namespace ramus::mesh {

struct SurfaceOptions {
    Method method = Method::kConvolutionSurface; // of a tree
    int smooth_passes = 1;                       // of voxels' stair-steps (core/tree/smooth.h)
    double prune_ratio = 0.0; // leaf branches shorter than ratio x parent go (core/tree/prepare.h); 0 keeps all
    double width = 5.0;       // kernel width; 5 is the paper's, 1 is Bloomenthal's
    field::KernelKind kernel = field::KernelKind::kGaussian;
    Blend blend = Blend::kTree; // where vessels blend
    tree::Centerline centerline = tree::Centerline::kSmooth;
    Radii radii = Radii::kPlain;            // which the surface has
    field::Rims rims = field::Rims::kApart; // how it ends at walls; overlapping for pictures
    int detail = 16;                        // triangles around a vessel
    double cell_mm = 0.0;                   // one cell size everywhere instead of detail; 0 = use detail
    int threads = 0;                        // 0 = all cores
    std::uint64_t memory_bytes = 0;         // most that the process shall take; 0 = half of the machine's
    bool operator==(const SurfaceOptions&) const = default;
};

// What a surface cost: for `--json`, `--verbose` and the benchmarks.
struct SurfaceStatistics {
    std::uint64_t evaluations = 0; // kernel evaluations, one per segment and point
    double seconds = 0.0;
    MatchedTree matched;
    Untangled untangled; // where it was asked for
};

struct Surface {
    TriangleMesh mesh;
    std::shared_ptr<const DiskPages> disk; // where its arrays are; null: in memory
    // What it is a mesh of, where it is for pictures; else null.
    std::shared_ptr<const field::SurfaceProjector> projector;
    SurfaceStatistics statistics;
};

using tree::PreparedTree;

// The tree as the surface sees it: pruned first, then smoothed.
[[nodiscard]] PreparedTree prepare_tree(const tree::VesselTree& source, const SurfaceOptions& options);

// What is left of a prepared tree without the hidden branches (by id in its source, not 0: hidden): its branches may be
// fewer, and run where these did.
[[nodiscard]] PreparedTree visible_part(PreparedTree prepared, std::span<const std::uint8_t> hidden);

// The kernel that is asked for.
[[nodiscard]] field::Kernel kernel_of(const SurfaceOptions& options);

// The field of the tree as prepared, without the hidden branches (by id in `source`, not 0: hidden). Its frame is that
// of the whole tree, so that hiding and pruning leave everything else as it is, to the last bit.
[[nodiscard]] field::VesselField make_field(const tree::VesselTree& source, const SurfaceOptions& options,
                                            std::span<const std::uint8_t> hidden);

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

// The error of a surface that has no triangle.
[[nodiscard]] tl::unexpected<Error> empty_surface(double cell_mm);

} // namespace ramus::mesh
