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
    std::span<const std::int32_t> branch; // by voxel, as in Supply; empty: it does not reach the organ
    std::span<const float> at;
};

// Numbers of voxels after cuts. A voxel is supplied if every supplying system that there is still reaches it, and
// drained if every draining system does.
template <class Number> struct RemnantOf {
    Number supplied{}, drained{};
    Number both{};            // supplied and drained
    std::vector<Number> lost; // by system: voxels that it no longer reaches
    [[nodiscard]] Number congested() const { return supplied - both; }
    [[nodiscard]] Number unsupplied() const { return drained - both; }
};
using Remnant = RemnantOf<std::size_t>;
using PartRemnant = RemnantOf<double>; // of voxels that remain in part

// Whether a voxel lies on the lost part of its branch. `spans`: by branch id, not empty.
[[nodiscard]] inline bool is_lost(const SystemSupply& system, std::span<const measure::LostSpan> spans,
                                  std::size_t voxel) {
    if (system.branch.empty()) return false;
    const measure::LostSpan& span = spans[static_cast<std::size_t>(system.branch[voxel])];
    const auto at = static_cast<double>(system.at[voxel]);
    return span.any() && at >= span.from && at <= span.to;
}

// `spans`: lost_spans() of the tree (measure/cuts.h), by branch id; empty: no cuts. `counted`: by voxel, 0: it is not
// part of the functional organ; empty: all count. Without a system of a role nothing is lost of it.
[[nodiscard]] Remnant remnant_of(std::span<const SystemSupply> systems, std::span<const measure::LostSpan> spans,
                                 std::span<const std::uint8_t> counted);

// The same for an organ of which a part was removed. `kept`: by voxel, the share of it that remains, 0 to 1; what was
// removed does not count.
[[nodiscard]] PartRemnant remnant_of(std::span<const SystemSupply> systems, std::span<const measure::LostSpan> spans,
                                     std::span<const std::uint8_t> counted, std::span<const float> kept);

// By voxel, not 0: it lies inside the wall of a vessel of at least this diameter (mm).
[[nodiscard]] std::vector<std::uint8_t> large_vessels(const Organ& organ, const tree::VesselTree& tree,
                                                      double least_diameter_mm);

} // namespace ramus::organ
