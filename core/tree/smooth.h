// Binomial smoothing of a tree's centerlines and radii, against the stair-steps of voxel grids.
#pragma once

#include "core/tree/vessel_tree.h"

namespace ramus::tree {

// `passes` passes of the (1 2 1) / 4 filter over positions and radii of every branch's inner points. A branching node
// becomes 1/2 itself + 1/2 (sum of r_k x_k / sum of r_k) over its neighbour points k, so that a stem is not dragged
// toward a twig; its radius likewise (weights r_k). End points stay.
[[nodiscard]] VesselTree smooth(VesselTree tree, int passes);

} // namespace ramus::tree
