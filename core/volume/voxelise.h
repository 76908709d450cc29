// Makes the segmentation mask of a tree that a scanner and a perfect segmentation would produce. For comparisons of
// surfaces from centerlines with surfaces from voxels, if the original mask is unknown.
#pragma once

#include "core/base/error.h"
#include "core/base/job.h"
#include "core/tree/vessel_tree.h"
#include "core/volume/bit_mask.h"

#include <glm/mat4x4.hpp>

namespace ramus::volume {

struct VoxelisedTree {
    BitMask mask;
    glm::dmat4 to_patient; // voxel indices, with whole numbers at voxel centres, to mm, RAS; axes parallel to RAS
};

// A voxel of side `voxel_mm` is inside if its centre is within the radius of a centerline; radii are linear between
// points. Fails if `voxel_mm` is not positive, if the mask would exceed `memory_bytes` (0: half of the machine's
// memory), if single precision cannot distinguish the voxels, if no voxel is inside because vessels are too thin, and
// when `job` is cancelled (what == "cancelled").
[[nodiscard]] Result<VoxelisedTree> voxelised(const tree::VesselTree& tree, double voxel_mm, double memory_bytes,
                                              Job& job);
[[nodiscard]] Result<VoxelisedTree> voxelised(const tree::VesselTree& tree, double voxel_mm);

// The same with anisotropic voxels.
[[nodiscard]] Result<VoxelisedTree> voxelised(const tree::VesselTree& tree, const glm::dvec3& voxel_mm,
                                              double memory_bytes, Job& job);

// A voxel size in mm at which nine of ten vessels are at least two voxels wide; larger if a side would otherwise have
// more than 768 voxels.
[[nodiscard]] double sensible_voxel_mm(const tree::VesselTree& tree);

} // namespace ramus::volume
