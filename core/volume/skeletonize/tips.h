// Where the vessels of a mask end. The way through the vessel from one of its ends has a farthest point at every other
// end; how much farther it is than the place where the vessel leaves the rest (its prominence, as that of a summit
// above the saddle to a higher one) is the length by which it stands out. A bulge stands out less than it is wide; a
// vessel more. That ratio is the one parameter, after the bulge size of Drees et al. ("Scalable robust graph and
// feature extraction for arbitrary vessel networks in large volumetric datasets", 2021).
#pragma once

#include "core/base/job.h"
#include "core/base/large_array.h"
#include "core/volume/skeletonize/voxel_set.h"

#include <functional>
#include <vector>

namespace ramus::volume {

// `distances`: waits for those of distance_transform.h, which may be measured meanwhile. Every piece has at least one
// tip, and two if it has several voxels. Stops early, with whatever was found, when `job` is cancelled.
[[nodiscard]] std::vector<VoxelSet::Address> find_tips(const VoxelSet& set,
                                                       const std::function<const LargeArray<float>&()>& distances,
                                                       double bulge_size, const JobRange& job);

} // namespace ramus::volume
