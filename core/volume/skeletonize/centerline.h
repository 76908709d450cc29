// From lines of voxels to centerlines, by the volume around them: positions between voxels at the centroids of the
// cross-sections, radii of circles of their area, ends where a vessel of the volume there ends.
#pragma once

#include "core/base/job.h"
#include "core/tree/build_tree.h"
#include "core/volume/skeletonize/branch_voxels.h"
#include "core/volume/skeletonize/voxel_graph.h"

namespace ramus::volume {

// Points and edges, in mm along the axes of the mask, from its first voxel.
[[nodiscard]] tree::Graph centerlines_of(const VoxelGraph& graph, const VoxelSet& set,
                                         const BranchVoxels& branch_voxels, const JobRange& job);

} // namespace ramus::volume
