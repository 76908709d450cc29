// The graph of a skeleton of single voxels: nodes where it ends or parts, lines of voxels between them. It has exactly
// the pieces and loops of the skeleton in (26, 6)-connectivity: voxels that meet in threes and fours are one node, and
// a ring within such a knot stays a ring.
#pragma once

#include "core/base/large_array.h"
#include "core/volume/skeletonize/voxel_set.h"

#include <glm/vec3.hpp>
#include <vector>

namespace ramus::volume {

// A place in the middle of a vessel: mm along the axes of the mask, from its first voxel.
struct MidPoint {
    glm::dvec3 position{0.0};
    double distance = 0.0;   // to the nearest voxel outside, mm
    std::uint32_t voxel = 0; // its number, or that of one of several
};

struct VoxelGraph {
    struct Line {
        int from = 0, to = 0;         // nodes; equal: a ring
        std::vector<MidPoint> points; // between them
    };
    std::vector<MidPoint> nodes;
    std::vector<Line> lines;

    [[nodiscard]] std::vector<int> degrees() const; // of each node: ends of lines there
};

// `skeleton`: a mask of the size of the box of `set`, of which `distances` are.
[[nodiscard]] VoxelGraph graph_of(const SparseMask& skeleton, const VoxelSet& set, const LargeArray<float>& distances);

[[nodiscard]] double length_mm(const VoxelGraph& graph, const VoxelGraph::Line& line);

} // namespace ramus::volume
