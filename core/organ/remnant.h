// Remnant: what remains of an organ after cuts. A voxel loses its supply (or its drainage) with the part of the branch
// that it belongs to.
#pragma once

#include "core/measure/cuts.h"
#include "core/organ/supply.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace ramus::organ {

// What a vessel system does for the organ.
enum class Role : std::uint8_t { kSupplies, kDrains };

// One vessel system and the voxels' branches of it.
struct SystemSupply {
    Role role = Role::kSupplies;
    std::span<const std::int32_t> branch; // by voxel, as in Supply
    std::span<const float> at;
};

// Numbers of voxels after cuts. A voxel is supplied if every supplying system that there is still reaches it, and
// drained if every draining system does.
struct Remnant {
    std::size_t supplied = 0, drained = 0;
    std::size_t both = 0;          // supplied and drained
    std::vector<std::size_t> lost; // by system: voxels that it no longer reaches
    [[nodiscard]] std::size_t congested() const { return supplied - both; }
    [[nodiscard]] std::size_t unsupplied() const { return drained - both; }
};

// `spans`: lost_spans() of the tree (measure/cuts.h), by branch id; empty: no cuts. `counted`: by voxel, 0: it is not
// part of the functional organ; empty: all count. Without a system of a role nothing is lost of it.
[[nodiscard]] Remnant remnant_of(std::span<const SystemSupply> systems, std::span<const measure::LostSpan> spans,
                                 std::span<const std::uint8_t> counted);

// By voxel, not 0: it lies inside the wall of a vessel of at least this diameter (mm).
[[nodiscard]] std::vector<std::uint8_t> large_vessels(const Organ& organ, const tree::VesselTree& tree,
                                                      double least_diameter_mm);

} // namespace ramus::organ
