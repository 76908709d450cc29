// The artificial vessel trees of the paper's figures, built exactly: straight branches that meet in a plane, vessels
// side by side, centerlines of voxels. All in mm, RAS, and small.
#pragma once

#include "core/tree/vessel_tree.h"

#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace ramus::app::paper {

// Straight branches of one radius that meet at the origin, in the plane y = 0, seen from the front: each in its
// direction, in degrees from the right of the picture, counter-clockwise. The first is the stem.
[[nodiscard]] tree::VesselTree star(std::span<const double> degrees, double radius_mm, double length_mm);

// Two vessels without a joint, in the plane y = 0, whose axes are so far apart everywhere.
[[nodiscard]] tree::VesselTree parallel_pair(double distance_mm, double radius_mm, double length_mm);
[[nodiscard]] tree::VesselTree s_shaped_pair(double distance_mm, double radius_mm);

// A bent vessel with a side branch, in the plane y = 0, aslant to the axes: what bounding volumes are drawn around.
[[nodiscard]] tree::VesselTree aslant_branching(double radius_mm);

// A winding vessel; with its points where they are, and as voxels of 1 mm have them: each at the centre of a voxel,
// from voxel to adjacent voxel, radii in halves of a voxel.
[[nodiscard]] tree::VesselTree winding_vessel();
[[nodiscard]] tree::VesselTree winding_vessel_of_voxels();
// mm from each point of the tree to the exact centerline of winding_vessel().
[[nodiscard]] std::vector<double> distances_to_winding_vessel(const tree::VesselTree& tree);

// A vessel of voxels with one side branch, and spurs of three voxels, as thinning leaves them.
struct SpurredVessel {
    tree::VesselTree tree;
    int spurs = 0;         // leaf branches that stand for nothing
    int real_branches = 0; // that are left without the spurs
};
[[nodiscard]] SpurredVessel spurred_vessel();

} // namespace ramus::app::paper
