// Projects points onto the surface of one vessel near contacts.
//
// The surface of a vessel consists of its own isosurface, of walls toward other vessels that claim the same points, and
// of the borders of shadows. Positions are in mm. The projection takes at most six first-order steps; convergence is
// not guaranteed.
#pragma once

#include "core/base/bounds.h"
#include "core/field/brick_field.h"
#include "core/field/dominance.h"
#include "core/field/separation.h"
#include "core/field/separation/vessel_views.h"

#include <cstdint>
#include <glm/vec3.hpp>

namespace ramus::field {

struct WallPoint {
    glm::dvec3 position{0.0}; // mm
    glm::dvec3 normal{0.0};   // unit, outward
    double radius = 0.0;      // local radius, mm
    std::int32_t branch = 0;
    Dominance dominance{};
    // Where rims overlap (rims.h): the way (mm) from a wall point to the vessel's own surface nearby, or from a point
    // near the edge of a shadow to that edge, and the unit normal there. Otherwise 0.
    glm::dvec3 onward{0.0}, onward_normal{0.0};
};

// Moves a point onto the surface of the vessel of segment `place` (index in the brick's list), within `bounds` (mm),
// which may be a box, a rectangle or a line. `onward`: the largest depth (mm) of a wall point below its vessel's own
// surface at which WallPoint::onward is set. Adds the number of kernels evaluated to `kernels`.
[[nodiscard]] WallPoint move_to_wall(VesselViews& views, std::uint32_t place, const glm::dvec3& guess,
                                     const Bounds<glm::dvec3>& bounds, double onward, std::uint64_t& kernels);

// Moves a point on to the vessel's own isosurface, to single precision, if that is no farther than `near_radii` radii.
// Returns what the point lies on.
[[nodiscard]] DrawnPoint::Place go_on_own_surface(VesselViews& views, std::uint32_t place, double near_radii,
                                                  WallPoint& point, std::uint64_t& kernels);

} // namespace ramus::field
