// Moves the vertices of a LabelNet to a surface of little bending.
//
// Energy: for each vertex the square of the distance to the mean of its neighbours (a discrete Laplacian, so that the
// sum is that of thin plates), plus a small weight times the square of the distance from where it starts. Lengths are
// in voxels: steps between thick slices are as high as others, and an affine image of a smooth surface is smooth. A
// vertex at a junction of three borders is compared with its two neighbours along the junction, and, on the organ's
// surface, along its normal with its neighbours on that. Vertices stay within half a voxel of their corner, along each
// axis. The energy is a convex quadratic form; the solver is an accelerated projected gradient (A. Beck and M.
// Teboulle, A Fast Iterative Shrinkage-Thresholding Algorithm, 2009).
#pragma once

#include "core/base/large_array.h"
#include "core/organ/surfaces/label_net.h"

namespace ramus::organ::surfaces {

// Largest distance of a vertex from its corner along each axis, in voxels; less than 0.5, so that vertices of
// neighbouring cells do not meet.
inline constexpr float kMostMove = 0.48F;

// By vertex: its place, in voxels. `least_voxels`: by vertex, the voxels of the smallest label that it touches; small
// parts keep their shape. Stops early when cancelled.
[[nodiscard]] LargeArray<glm::vec3> relaxed(const LabelNet& net, std::span<const std::uint32_t> least_voxels,
                                            const JobRange& job);

} // namespace ramus::organ::surfaces
