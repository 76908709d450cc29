// The surface of one vessel where others are kept apart from it: its own isosurface, and where others claim what it
// claims, a wall.
#pragma once

#include "core/base/bounds.h"
#include "core/field/apart/vessel_views.h"
#include "core/field/brick_field.h"
#include "core/field/dominance.h"
#include "core/field/separation.h"

#include <cstdint>
#include <glm/vec3.hpp>

namespace ramus::field {

struct WallPoint {
    glm::dvec3 position{0.0}; // mm
    glm::dvec3 normal{0.0};   // unit, outward
    double radius = 0.0;      // local radius, mm
    std::int32_t branch = 0;
    Dominance dominance{};
    // Where rims overlap (rims.h): of a point on a wall that is near the vessel's own surface, the way on to that; of
    // one near the edge of what an obstacle cuts off, the way to the edge; mm, and the unit normal there. Else 0.
    glm::dvec3 onward{0.0}, onward_normal{0.0};
};

// Moves a point onto the surface of the vessel of a segment (by its place in the brick's list), within bounds in mm,
// which may be flat or a line. `onward`: how far below its vessel's own surface a point of a wall is told the way
// there, mm. Adds up the kernels evaluated.
[[nodiscard]] WallPoint move_to_wall(VesselViews& views, std::uint32_t place, const glm::dvec3& guess,
                                     const Bounds<glm::dvec3>& bounds, double onward, std::uint64_t& kernels);

// Moves a point on to the vessel's own surface, as near as single precision tells, if that is no farther than so many
// radii. Says what the point is on.
[[nodiscard]] DrawnPoint::Place go_on_own_surface(VesselViews& views, std::uint32_t place, double near_radii,
                                                  WallPoint& point, std::uint64_t& kernels);

} // namespace ramus::field
