// Rims: how the surface of a vessel ends at the border of a wall (core/field/separation).
#pragma once

#include <cstdint>

namespace ramus::field {

enum class Rims : std::uint8_t {
    kApart, // each vessel ends on its side of the wall, so that surfaces do not intersect: for files
    // The surface continues along the vessel's own tube by up to two cells, inside the other vessel: for pictures,
    // where the depth test then draws a clean crease whatever the cell size.
    kOverlapping,
};

} // namespace ramus::field
