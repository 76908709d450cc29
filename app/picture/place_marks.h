// Rings and dots that mark places in the picture.
#pragma once

#include "render/scene/frame.h"

namespace ramus::app {

// A ring around `at` that faces the eye, as wide as the vessel (`radius_mm`) and large enough to be visible at any
// distance. `strong`: larger and thicker. `frame` must have camera, size and pixel ratio.
[[nodiscard]] render::MarkLine ring_facing_eye(const render::Frame& frame, const glm::dvec3& at, double radius_mm,
                                               const glm::vec3& colour, bool strong);

// A dot of constant size in the picture, for the ends of measurements.
[[nodiscard]] render::MarkLine dot_at(const render::Frame& frame, const glm::dvec3& at, const glm::vec3& colour);

} // namespace ramus::app
