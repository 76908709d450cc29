// Where the convolution surface lies around places of the centerlines.
#pragma once

#include "render/caster/cast_types.h"

#include <cstddef>

namespace ramus::render::caster {

// Across the vessel at a place: the circle that is nearest to the surface there.
struct Across {
    float middle[3], side[3], up[3]; // side, up: unit vectors across it; in the space of the field's pieces
    float radius;                    // of the vessel, then of the circle
    float least, most;               // that the radius may be, in radii of the vessel
    std::uint32_t near;              // a segment there, whose near pieces are the surface
};
void fit_circles(const Field& field, Across* places, std::size_t count);

} // namespace ramus::render::caster
