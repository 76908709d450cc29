// Extends the ends of centerlines to the border of the volume where the border cuts the vessel.
#pragma once

#include "core/tree/build_tree.h"
#include "core/volume/skeletonize/voxel_set.h"

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace ramus::volume {

struct VolumeCut {
    std::uint32_t point = 0; // index in the graph; now in the plane of the border
    glm::dvec3 outward{0.0}; // unit vector along an axis of the volume
};

// `graph`: in mm along the axes of a mask of `size` voxels, from its first voxel. An end counts as cut if the vessel,
// continued straight, leaves the volume within about two radii, not nearly parallel to the border, and voxels of the
// mask cover half of its width there. So a round tip that only touches the border stays as it is. Returns the cut ends.
[[nodiscard]] std::vector<VolumeCut> extend_to_border(tree::Graph& graph, const VoxelSet& set, const glm::ivec3& size);

} // namespace ramus::volume
