// Finds the ends (tips) of the vessels in a mask. The geodesic distance from one end of a piece has a local maximum at
// every other end. Its prominence (height above the saddle to a higher maximum, as for summits) is the length by which
// the vessel stands out. The prominence of a bulge is less than `bulge_size` times its thickness. This parameter
// follows the bulge size of Drees et al. ("Scalable robust graph and feature extraction for arbitrary vessel networks
// in large volumetric datasets", 2021).
#pragma once

#include "core/base/job.h"
#include "core/base/large_array.h"
#include "core/volume/skeletonize/voxel_set.h"

#include <functional>
#include <vector>

namespace ramus::volume {

// `distances`: returns those of distance_transform.h, and may wait until they are computed. Every piece gets at least
// one tip; a piece of several voxels at least two, which may be the same voxel. Incomplete when cancelled.
[[nodiscard]] std::vector<VoxelSet::Address> find_tips(const VoxelSet& set,
                                                       const std::function<const LargeArray<float>&()>& distances,
                                                       double bulge_size, const JobRange& job);

} // namespace ramus::volume
