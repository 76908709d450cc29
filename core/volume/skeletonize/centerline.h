// Computes centerlines from the lines of a voxel graph and the volume around them: positions at the centroids of
// cross-sections (between voxels), radii of circles with the area of the cross-section, and end points from the volume
// of the ends.
#pragma once

#include "core/base/job.h"
#include "core/tree/build_tree.h"
#include "core/volume/skeletonize/branch_voxels.h"
#include "core/volume/skeletonize/voxel_graph.h"

namespace ramus::volume {

// Returns points and edges in mm along the axes of the mask, from its first voxel. Empty when cancelled. The result
// does not depend on threads.
[[nodiscard]] tree::Graph centerlines_of(const VoxelGraph& graph, const VoxelSet& set,
                                         const BranchVoxels& branch_voxels, const JobRange& job);

} // namespace ramus::volume
