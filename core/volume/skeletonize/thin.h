// Thinning: removes simple points (simple_point.h) from a set, those nearest to the outside first, until a skeleton of
// single voxels remains (C. Pudney, "Distance-ordered homotopic thinning", 1998). Guaranteed: the skeleton has the
// topology of the set.
#pragma once

#include "core/base/job.h"
#include "core/base/large_array.h"
#include "core/volume/skeletonize/voxel_set.h"

#include <vector>

namespace ramus::volume {

struct Thinned {
    SparseMask skeleton; // of the size of the set's box
    // By number of the voxel: the neighbour, as a bit of a neighbourhood, with the steepest ascent of the distance when
    // the voxel was removed; kCentreBit: the voxel is in the skeleton. Every path of such steps ends in the skeleton.
    // Paths stay in their vessel: touching vessels are separated where the mask between them is thinnest.
    LargeArray<std::uint8_t> uphill;
};

// Keeps the voxels `kept`, and others only as far as the topology needs them. The result is incomplete when cancelled.
[[nodiscard]] Thinned thin(const VoxelSet& set, const LargeArray<float>& distances,
                           const std::vector<VoxelSet::Address>& kept, const JobRange& job);

} // namespace ramus::volume
