// Dominance: by how much the strongest branch at a vertex exceeds the next two. Shaders interpolate it to draw borders
// between branches.
#pragma once

#include <array>
#include <cstdint>

namespace ramus::field {

// `over`: the natural logarithm of the strongest branch's share of the field divided by the shares of the next two
// branches, in steps of kMostDominance / 255; 0 where two branches contribute equally. `rivals`: the lowest bytes of
// the ids of these two branches, enough to distinguish neighbours.
struct Dominance {
    std::array<std::uint8_t, 2> over, rivals;
    bool operator==(const Dominance&) const = default;
};
inline constexpr double kMostDominance = 8.0; // larger values are clamped

} // namespace ramus::field
