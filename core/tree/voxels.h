// The voxels that a tree's points come from, where they come from voxels: how long a step of the smoothing filter is
// (core/tree/smooth.h).
//
// A tree that was made of a mask has the mask's voxels. Of other files, voxels are estimated from the points: where
// centerlines go from voxel to adjacent voxel, all coordinates change by one step or not at all. Anything else (points
// that are farther apart, that lie between voxels, straight lines) has no voxels.
#pragma once

#include "core/tree/vessel_tree.h"

#include <glm/mat3x3.hpp>
#include <optional>

namespace ramus::tree {

// The lengths of a voxel's three edges, mm.
[[nodiscard]] glm::dvec3 sizes_mm(const Voxels& voxels);
// The edge of a cube as large as a voxel, mm.
[[nodiscard]] double mean_size_mm(const Voxels& voxels);

// Of the tree's points as they are, whatever `tree.voxels` says; edges along x, y and z.
[[nodiscard]] std::optional<Voxels> estimated_voxels(const VesselTree& tree);

// Whether three edges can be those of a voxel: finite, and far from lying in one plane.
[[nodiscard]] bool is_a_voxel(const glm::dmat3& edges_mm);

} // namespace ramus::tree
