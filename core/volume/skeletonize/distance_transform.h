// The exact Euclidean distance from every voxel of a set to the nearest voxel outside of it, centre to centre, in mm,
// for voxels of any proportions (A. Meijster, J. Roerdink, W. Hesselink, "A general algorithm for computing distance
// transforms in linear time", 2000: one axis after the other). Only voxels of the set are visited.
#pragma once

#include "core/base/large_array.h"
#include "core/volume/skeletonize/voxel_set.h"

namespace ramus::volume {

// By number of the voxel.
[[nodiscard]] LargeArray<float> distances_to_outside(const VoxelSet& set);

} // namespace ramus::volume
