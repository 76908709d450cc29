// Rims: how the surface of a vessel ends where a wall between it and another vessel does.
#pragma once

#include <cstdint>

namespace ramus::field {

enum class Rims : std::uint8_t {
    kApart, // on its side of the wall, so that nothing meets
    // It goes on along the vessel's own tube, by two cells at most, hidden in the other vessel: for pictures, where
    // what is nearer to the eye then makes a clean crease of the rim, whatever the cells.
    kOverlapping,
};

} // namespace ramus::field
