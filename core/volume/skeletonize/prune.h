// Removes from a skeleton's graph what is no vessel: spurs in bulges of the wall, and on request cycles.
#pragma once

#include "core/volume/skeletonize/voxel_graph.h"

namespace ramus::volume {

// A cycle that break_cycles() broke, by the line that it removed.
struct BrokenCycle {
    glm::dvec3 at{0.0};    // the thinnest point of the line, mm
    double distance = 0.0; // of that point to the nearest outside voxel, mm
};

// Removes a line from each cycle, the one with the thinnest point: a bridge between touching vessels, or the rim of a
// hole in the mask. What remains is a maximum spanning forest with respect to the thinnest points.
[[nodiscard]] std::vector<BrokenCycle> break_cycles(VoxelGraph& graph);

// Removes leaf lines that are bulges of the wall, the shortest first. A leaf is a bulge if it extends less than
// `bulge_size` times its own thickness plus one voxel beyond the inscribed ball of the node where it begins; or nowhere
// that far, plus a voxel of roughness, beyond the balls along the other lines at that node. Merges the two lines of a
// node that has only two left. Keeps the last line of a piece. `spacing`: of the voxels, mm.
void prune_bulges(VoxelGraph& graph, double bulge_size, const glm::dvec3& spacing);

} // namespace ramus::volume
