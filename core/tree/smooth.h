// Smooths centerlines and radii to remove the stair-steps of voxels.
//
// The paper's filter, (previous + 2 self + next) / 4 over points that are adjacent voxels, is one step of a diffusion
// along the centerline. If points are a distance h apart, a step moves a point by h^2 / 4 times the second derivative
// of the centerline, and its weights have the variance h^2 / 2. smooth() computes this diffusion by arc length, with h
// = 1 voxel. It equals the paper's filter if points are a voxel apart, does almost nothing to points that are far
// apart, and acts over the length of a voxel if points are closer. Lengths are counted in steps from a voxel to one of
// its 26 neighbours (core/tree/SMOOTHING.md has the derivation).
//
// Guarantees: a tree without voxels does not change. No point moves by more than half a voxel, nor by more than half of
// its radius, and no radius changes by more, whatever the number of passes. End points stay.
// Source: S. Oeltze and B. Preim, IEEE Transactions on Medical Imaging 24 (4), 2005, section III.
#pragma once

#include "core/tree/vessel_tree.h"

#include <glm/vec3.hpp>

namespace ramus::tree {

// Runs `passes` passes over positions and radii. At a branching node, x becomes 1/2 x + 1/2 (sum of r_k x_k / sum of
// r_k) over its neighbours k if these are a voxel away, so that a twig does not pull the stem toward it. Radii have the
// same weights.
[[nodiscard]] VesselTree smooth(VesselTree tree, int passes);

// How far smoothing moves the points that branches use.
struct Displacement {
    double median_mm = 0.0, largest_mm = 0.0;
    double median_radii = 0.0, largest_radii = 0.0; // in the points' radii before smoothing
    glm::dvec3 at{0.0};                             // mm: the point that moves farthest, before smoothing
};
// `after`: `before`, smoothed.
[[nodiscard]] Displacement displacement_of(const VesselTree& before, const VesselTree& after);

} // namespace ramus::tree
