// Converts a segmentation mask to a vessel tree.
//
// Guaranteed: the tree has exactly the pieces and tunnels (as loops) of the mask, with voxels connected by faces, edges
// and corners, except what `fill_holes` and `islands_mm` remove. Cavities are filled first, because no centerline can
// go around one. Positions are at the centroids of cross-sections, between voxels; a radius is that of the circle with
// the area of the cross-section, also for anisotropic voxels. Each of `systems` is a system of its own, not connected
// with others.
//
// Not guaranteed: that every branch is a vessel. Holes in the mask of a vessel become loops.
//
// Arrays by voxel that take more than `memory_bytes` leave are on the disk ($TMPDIR, or /var/tmp); the tree is the
// same.
//
// The steps: distances to the outside (distance_transform.h), tips (tips.h), thinning (thin.h), graph (voxel_graph.h),
// pruning (prune.h), centerlines (centerline.h), ends at the border (cut_ends.h). Each header names its source.
#pragma once

#include "core/base/error.h"
#include "core/base/job.h"
#include "core/tree/vessel_tree.h"
#include "core/volume/bit_mask.h"
#include "core/volume/skeletonize/systems.h"
#include "core/volume/volume.h"

#include <cstdint>
#include <optional>
#include <span>

namespace ramus::volume {

struct SkeletonizeOptions {
    // The only parameter: a bulge is a vessel if it stands out by more than this times its thickness, plus a voxel.
    double bulge_size = 0.5;
    bool fill_holes = false;        // removes a line from each cycle (prune.h)
    double islands_mm = 0.0;        // removes pieces whose bounding box is not longer along any axis
    std::optional<glm::dvec3> root; // mm, RAS: the nearest end becomes the root of its piece
    double memory_bytes = 0.0;      // memory limit of the process; 0: half of the machine's memory
};

// Statistics of all systems together.
struct SkeletonizeFigures {
    std::uint64_t voxels = 0, pieces = 0, tunnels = 0, cavities_filled = 0, islands_dropped = 0;
};

// Makes one tree from the masks of all `systems`, in their order. Frees the voxels before it works on the last system.
// Fails like inside() (bit_mask.h), if it would exceed the memory limit, if all pieces of a system are islands, and
// when `job` is cancelled (what == "cancelled").
[[nodiscard]] Result<tree::VesselTree> skeletonize(Volume&& volume, std::span<const SystemMask> systems,
                                                   const SkeletonizeOptions& options, Job& job,
                                                   SkeletonizeFigures* figures = nullptr);

// The same for one mask, without systems. `to_patient`: voxel indices to mm, RAS.
[[nodiscard]] Result<tree::VesselTree> skeletonize(BitMask mask, const glm::dmat4& to_patient,
                                                   const SkeletonizeOptions& options, Job& job,
                                                   SkeletonizeFigures* figures = nullptr);

} // namespace ramus::volume
