// Determines the voxels that a tree's points come from. They give the step length of the smoothing filter
// (core/tree/smooth.h).
//
// A tree extracted from a mask has the voxels of the mask. For other files, voxels are estimated from the points: along
// a centerline that goes from voxel to adjacent voxel, each coordinate changes by one step or not at all. Other trees
// (points that are farther apart or lie between voxels, straight lines) have no voxels.
#pragma once

#include "core/tree/vessel_tree.h"

#include <glm/mat3x3.hpp>
#include <optional>

namespace ramus::tree {

// The lengths of a voxel's three edges, mm.
[[nodiscard]] glm::dvec3 sizes_mm(const Voxels& voxels);
// The edge of a cube as large as a voxel, mm.
[[nodiscard]] double mean_size_mm(const Voxels& voxels);

// Estimates voxels with edges along x, y and z from the points alone; ignores `tree.voxels`.
[[nodiscard]] std::optional<Voxels> estimated_voxels(const VesselTree& tree);

// Whether three edges can be the edges of a voxel: finite, and far from coplanar.
[[nodiscard]] bool is_a_voxel(const glm::dmat3& edges_mm);

} // namespace ramus::tree
