// Smoothing of centerlines and radii against the stair-steps of voxels.
//
// The paper's filter, (previous + 2 self + next) / 4 over points that are adjacent voxels, is a step of a diffusion
// along the centerline: where points are h apart it moves a point by h^2 / 4 times the second derivative of the
// centerline there, and its weights have the variance h^2 / 2. smooth() is this diffusion by arc length, with h a
// voxel: the same filter where points are a voxel apart; hardly anything where they are far apart, as between points
// that somebody placed; and over a voxel's length, not less, where they are closer. Lengths are counted in steps from
// voxel to voxel, of which one leads to any of the 26 adjacent ones (core/tree/SMOOTHING.md has the derivation).
//
// Guarantees: a tree without voxels stays as it is. No point moves by more than half a voxel, nor by more than half of
// its radius; no radius changes by more, whatever the number of passes. End points stay.
// Source: S. Oeltze and B. Preim, IEEE Transactions on Medical Imaging 24 (4), 2005, section III.
#pragma once

#include "core/tree/vessel_tree.h"

#include <glm/vec3.hpp>

namespace ramus::tree {

// `passes` passes over positions and radii. At a branching node, x becomes 1/2 x + 1/2 (sum of r_k x_k / sum of r_k)
// over its neighbours k where these are a voxel away, so that a stem is not dragged toward a twig; its radius becomes
// the same mean of radii.
[[nodiscard]] VesselTree smooth(VesselTree tree, int passes);

// How far smoothing moves the points that branches use.
struct Displacement {
    double median_mm = 0.0, largest_mm = 0.0;
    double median_radii = 0.0, largest_radii = 0.0; // in radii of the points as they were
    glm::dvec3 at{0.0};                             // mm: the point that moves farthest, as it was
};
// `after` is `before`, smoothed.
[[nodiscard]] Displacement displacement_of(const VesselTree& before, const VesselTree& after);

} // namespace ramus::tree
