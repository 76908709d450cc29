// Cameras that bring a tree into the picture.
#pragma once

#include "app/assets/assets.h"
#include "app/session/session.h"
#include "render/scene/frame.h"

#include <glm/vec3.hpp>
#include <vector>

namespace ramus::app {

// `camera`, that a tree's own surface fills the picture of, farther away where the isosurface stands beside it: a mask
// reaches beyond the ends of its centerlines.
[[nodiscard]] render::Camera with_room(render::Camera camera, const Comparison& comparison);

// From where a tree is seen first: from the front, or facing the largest side of one that is flat, so that it is not
// seen edge-on.
[[nodiscard]] render::View opening_view(const tree::VesselTree& tree);

// Of the context that is shown, as far as it was read.
[[nodiscard]] std::vector<glm::vec3> shown_positions(const Marks& marks, const Assets& assets);

// Whether anything of the context that is shown may be in the picture, as far as boxes tell.
[[nodiscard]] bool context_in_view(const render::Frame& frame);

// `camera` from the same side, near enough to see what is around `at`, where vessels have this radius; never farther
// than it is. `size`: of the picture.
[[nodiscard]] render::Camera looking_at(const render::Camera& camera, const glm::dvec3& at, double radius_mm,
                                        glm::ivec2 size);

} // namespace ramus::app
