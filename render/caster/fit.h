// Where the convolution surface lies around points of the centerlines.
#pragma once

#include "render/caster/cast_types.h"

#include <cstddef>

namespace ramus::render::caster {

// A vessel's cross section: the circle that is nearest to the surface there.
struct CrossSection {
    float middle[3], side[3], up[3]; // side, up: unit vectors in its plane; in the space of the field's segments
    float radius;                    // of the vessel, then of the circle
    float least, most;               // that the radius may be, in radii of the vessel
    std::uint32_t segment;           // there, whose neighbours make the surface
};
void fit_circles(const Field& field, CrossSection* sections, std::size_t count);

} // namespace ramus::render::caster
