// Converts a skeleton of single voxels to a graph: nodes at its ends and branchings, and lines of voxels between them.
// Guaranteed: the graph has exactly the pieces and loops of the skeleton in (26, 6)-connectivity. Adjacent branching
// voxels become one node; if they contain a loop, it is kept.
#pragma once

#include "core/base/large_array.h"
#include "core/volume/skeletonize/voxel_set.h"

#include <glm/vec3.hpp>
#include <vector>

namespace ramus::volume {

// A point of the skeleton. Positions are in mm along the axes of the mask, from its first voxel.
struct MidPoint {
    glm::dvec3 position{0.0};
    double distance = 0.0;   // to the nearest outside voxel, mm
    std::uint32_t voxel = 0; // number of its voxel in the set, or of one of several
};

struct VoxelGraph {
    struct Line {
        int from = 0, to = 0;         // nodes; equal for a ring
        std::vector<MidPoint> points; // between them
    };
    std::vector<MidPoint> nodes;
    std::vector<Line> lines;

    [[nodiscard]] std::vector<int> degrees() const; // by node: number of line ends; a ring counts twice
};

// `skeleton`: a mask of the size of the box of `set`. `distances`: to the outside, by number in `set`.
[[nodiscard]] VoxelGraph graph_of(const SparseMask& skeleton, const VoxelSet& set, const LargeArray<float>& distances);

[[nodiscard]] double length_mm(const VoxelGraph& graph, const VoxelGraph::Line& line);

} // namespace ramus::volume
