// Ends of centerlines at which the border of the volume cuts the vessel: they are led on to the border.
#pragma once

#include "core/tree/build_tree.h"
#include "core/volume/skeletonize/voxel_set.h"

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace ramus::volume {

struct VolumeCut {
    std::uint32_t point = 0; // of the graph: now in the border's plane
    glm::dvec3 outward{0.0}; // along an axis of the volume
};

// `graph`: in mm along the axes of a mask of `size` voxels, from its first voxel. An end is cut where its vessel,
// straight on, leaves the volume within two radii, not along the border, and the voxels at the border there are its own
// over half of its width: a round tip that only touches the border stays as it is.
[[nodiscard]] std::vector<VolumeCut> extend_to_border(tree::Graph& graph, const VoxelSet& set, const glm::ivec3& size);

} // namespace ramus::volume
