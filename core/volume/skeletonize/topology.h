// Counts the pieces, tunnels and cavities of a mask, fills cavities and removes small pieces. Inside voxels are
// connected by faces, edges and corners (26), outside voxels by faces (6).
#pragma once

#include "core/volume/sparse_mask.h"

#include <cstdint>
#include <glm/vec3.hpp>

namespace ramus::volume {

struct Topology {
    std::uint64_t pieces = 0, tunnels = 0, cavities = 0;
    bool operator==(const Topology&) const = default;
};
[[nodiscard]] Topology topology_of(const SparseMask& mask);

// Sets the voxels of all cavities (pieces of the outside that do not reach the border). Returns their number.
std::uint64_t fill_cavities(SparseMask& mask);

// Removes pieces whose bounding box has no side longer than `extent_mm`. Returns their number. `spacing`: mm.
std::uint64_t drop_islands(SparseMask& mask, const glm::dvec3& spacing, double extent_mm);

} // namespace ramus::volume
