// Fits cameras to trees, context and places.
#pragma once

#include "app/assets/assets.h"
#include "app/session/session.h"
#include "render/scene/frame.h"

#include <glm/vec3.hpp>
#include <vector>

namespace ramus::app {

// Moves `camera`, which is fitted to the tree's own surface, farther away if an isosurface is shown next to it: a mask
// extends beyond the ends of centerlines.
[[nodiscard]] render::Camera with_room(render::Camera camera, const Comparison& comparison);

// The initial view: from the front, or facing the largest side of a flat tree, which would otherwise be seen edge-on.
[[nodiscard]] render::View opening_view(const tree::VesselTree& tree);

// Whether visible context may be in the picture, judged by bounding boxes.
[[nodiscard]] bool context_in_view(const render::Frame& frame);

// Moves `camera` close to `at`, where vessels have this radius, without turning it; never farther away than before.
// `size`: of the picture.
[[nodiscard]] render::Camera looking_at(const render::Camera& camera, const glm::dvec3& at, double radius_mm,
                                        glm::ivec2 size);

} // namespace ramus::app
