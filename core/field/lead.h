// Whose a place of the surface is, and how clearly.
#pragma once

#include <array>
#include <cstdint>

namespace ramus::field {

// How far the branch that contributes most to the field is before the two that come after it: the logarithm of its
// share over theirs, of kLargestLead, of 255. 0 where two branches meet. Of the others' ids the lowest byte, which is
// enough to tell neighbours apart.
struct Lead {
    std::array<std::uint8_t, 2> over, rivals;
    bool operator==(const Lead&) const = default;
};
inline constexpr double kLargestLead = 8.0; // and beyond

} // namespace ramus::field
