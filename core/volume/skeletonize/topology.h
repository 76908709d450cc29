// What digital topology says of a mask, whose voxels are joined by faces, edges and corners (26) and whose outside is
// joined by faces (6): pieces, tunnels, cavities. And the two changes of it that people ask for.
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

// Makes every part of the outside that no way leads out of part of the inside. Returns how many such parts there were.
std::uint64_t fill_cavities(SparseMask& mask);

// Removes pieces whose box is nowhere longer than `extent_mm`. Returns how many went.
std::uint64_t drop_islands(SparseMask& mask, const glm::dvec3& spacing, double extent_mm);

} // namespace ramus::volume
