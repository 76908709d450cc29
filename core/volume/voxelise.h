// A segmentation mask of a tree whose mask is not known: what a scanner and a perfect segmentation would have left of
// it. For comparisons of surfaces made of centerlines with surfaces made of voxels.
#pragma once

#include "core/base/error.h"
#include "core/base/job.h"
#include "core/tree/vessel_tree.h"
#include "core/volume/bit_mask.h"

#include <glm/mat4x4.hpp>

namespace ramus::volume {

struct VoxelisedTree {
    BitMask mask;
    glm::dmat4 to_patient; // of voxel indices, whole numbers at the centres, to mm, RAS; axes as the patient's
};

// Voxels of `voxel_mm` a side whose centre lies within a vessel: within the radius of its centerline, linear between
// points. Fails when `voxel_mm` is not positive and when the voxels would take more than `memory_bytes` (0: half of
// the machine's), lie where single precision cannot tell them apart, or vessels are so much thinner than voxels that
// nothing is inside, and when `job` is cancelled (what
// == "cancelled").
[[nodiscard]] Result<VoxelisedTree> voxelised(const tree::VesselTree& tree, double voxel_mm, double memory_bytes,
                                              Job& job);
[[nodiscard]] Result<VoxelisedTree> voxelised(const tree::VesselTree& tree, double voxel_mm);

// The same with voxels of any proportions, as scanners make them.
[[nodiscard]] Result<VoxelisedTree> voxelised(const tree::VesselTree& tree, const glm::dvec3& voxel_mm,
                                              double memory_bytes, Job& job);

// A voxel size at which nine vessels in ten are at least two voxels wide, and no side has more than 768 voxels; mm.
[[nodiscard]] double sensible_voxel_mm(const tree::VesselTree& tree);

} // namespace ramus::volume
