// What of a skeleton's graph is no vessel: bulges of the wall, and loops where they are not wanted.
#pragma once

#include "core/volume/skeletonize/voxel_graph.h"

namespace ramus::volume {

// Lines that were left out of a loop.
struct ClosedLoop {
    glm::dvec3 at{0.0};    // its thinnest place
    double distance = 0.0; // there, to the nearest voxel outside, mm
};

// Leaves out the lines that close loops, those with the thinnest place first: a bridge between vessels that touch, the
// rim of a hole in the mask. What is left is the spanning forest with the widest ways.
[[nodiscard]] std::vector<ClosedLoop> close_loops(VoxelGraph& graph);

// Removes leaves that are bulges of the wall, the shortest first. A leaf is one when it reaches less than `bulge_size`
// times its own thickness, and a voxel, beyond the ball around the node where it leaves; or nowhere that far, and the
// depth of a surface that is rough by a voxel, beyond the balls along the other vessels there. Nodes that are left with
// two lines become points of one. The last line of a piece stays. `spacing`: of the voxels, mm.
void prune_bulges(VoxelGraph& graph, double bulge_size, const glm::dvec3& spacing);

} // namespace ramus::volume
