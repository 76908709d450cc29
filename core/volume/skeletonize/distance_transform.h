// The exact Euclidean distance from every voxel of a set to the nearest voxel outside, centre to centre, in mm, also
// for anisotropic voxels. Works on one axis after the other, as A. Meijster, J. Roerdink and W. Hesselink, "A general
// algorithm for computing distance transforms in linear time", 2000. Not in linear time: the search along a line takes
// up to the distance for each voxel. Visits only voxels of the set.
#pragma once

#include "core/base/large_array.h"
#include "core/volume/skeletonize/voxel_set.h"

namespace ramus::volume {

// The distances by number of the voxel (VoxelSet::number()).
[[nodiscard]] LargeArray<float> distances_to_outside(const VoxelSet& set);

} // namespace ramus::volume
