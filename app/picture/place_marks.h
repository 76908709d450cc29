// Rings that face the eye, around places of a tree that pictures point at.
#pragma once

#include "render/scene/frame.h"

namespace ramus::app {

// Around `at`, as wide as the vessel needs (`radius_mm`) and wide enough to be seen from anywhere; a `strong` one is
// larger and thicker than others. `frame` has its camera, size and pixel ratio.
[[nodiscard]] render::MarkLine ring_facing_eye(const render::Frame& frame, const glm::dvec3& at, double radius_mm,
                                               const glm::vec3& colour, bool strong);

// A dot that looks as large from anywhere: where something that was measured ends.
[[nodiscard]] render::MarkLine dot_at(const render::Frame& frame, const glm::dvec3& at, const glm::vec3& colour);

} // namespace ramus::app
