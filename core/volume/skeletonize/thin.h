// Thinning: voxels are taken out of a set one by one, those nearest to the outside first, as long as its topology
// stays, until a skeleton of single voxels through its middle is left (C. Pudney, "Distance-ordered homotopic
// thinning", 1998).
#pragma once

#include "core/base/job.h"
#include "core/base/large_array.h"
#include "core/volume/skeletonize/voxel_set.h"

#include <vector>

namespace ramus::volume {

struct Thinned {
    SparseMask skeleton; // of the size of the set's box
    // By number of the voxel: which of its neighbours, as a bit of a neighbourhood, stood the steepest way up when it
    // was taken out; kCentreBit: it stayed. Every way of such steps ends in the skeleton, and no way leaves the vessel
    // that its voxel is part of: vessels that touch part where the mask is thinnest between them.
    LargeArray<std::uint8_t> uphill;
};

// `kept` stay whatever they are, of the other voxels those that the topology needs. Cancelled: anything.
[[nodiscard]] Thinned thin(const VoxelSet& set, const LargeArray<float>& distances,
                           const std::vector<VoxelSet::Address>& kept, const JobRange& job);

} // namespace ramus::volume
