// From a segmentation mask to a vessel tree.
//
// Guarantees: the tree has exactly the pieces and tunnels (as loops) of the mask, voxels joined by faces, edges and
// corners; cavities are filled first, for no centerline can go around one. Positions lie between voxels, in the middle
// of the cross-sections; a radius is that of the circle with the area of the cross-section, on voxels of any
// proportions. Each label of `labels` is a system of its own, joined with no other.
//
// The steps: distances to the outside, tips (tips.h), thinning (thin.h), graph (voxel_graph.h), centerlines
// (centerline.h), each with its source in its header.
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
    // The parameter of robustness: a bulge is a vessel where it stands out farther than this times its thickness, and a
    // voxel.
    double bulge_size = 0.5;
    bool fill_holes = false;        // tunnels through one vessel are closed
    double islands_mm = 0.0;        // pieces that are nowhere longer are left out
    std::optional<glm::dvec3> root; // mm, RAS: the end nearest to it becomes the root of its piece
    double memory_bytes = 0.0;      // most that the process shall take; 0 = half of the machine's
};

// What was found on the way, of all systems together.
struct SkeletonizeFigures {
    std::uint64_t voxels = 0, pieces = 0, tunnels = 0, cavities_filled = 0, islands_dropped = 0;
};

// Fails like inside() (bit_mask.h), when it takes more memory than allowed, and when `job` is cancelled (what ==
// "cancelled"). The voxels go before the last system is worked out.
[[nodiscard]] Result<tree::VesselTree> skeletonize(Volume&& volume, std::span<const SystemMask> systems,
                                                   const SkeletonizeOptions& options, Job& job,
                                                   SkeletonizeFigures* figures = nullptr);

// The same of one mask.
[[nodiscard]] Result<tree::VesselTree> skeletonize(BitMask mask, const glm::dmat4& to_patient,
                                                   const SkeletonizeOptions& options, Job& job,
                                                   SkeletonizeFigures* figures = nullptr);

} // namespace ramus::volume
