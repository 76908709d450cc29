// How clearly one branch contributes more than the others at a point of the surface.
#pragma once

#include <array>
#include <cstdint>

namespace ramus::field {

// `over`: the natural logarithm of the strongest branch's share of the field over those of the two branches that come
// next, in steps of kMostDominance / 255; 0 where two branches contribute the same. `rivals`: the lowest bytes of those
// two branches' ids, enough to tell neighbours apart. Between vertices this says where one branch ends and the next
// begins.
struct Dominance {
    std::array<std::uint8_t, 2> over, rivals;
    bool operator==(const Dominance&) const = default;
};
inline constexpr double kMostDominance = 8.0; // and beyond

} // namespace ramus::field
