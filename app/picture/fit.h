// Cameras that bring a tree into the picture.
#pragma once

#include "app/session/session.h"

namespace ramus::app {

// `camera`, that a tree's own surface fills the picture of, farther away where the isosurface stands beside it: a mask
// reaches beyond the ends of its centerlines.
[[nodiscard]] render::Camera with_room(render::Camera camera, const Comparison& comparison);

} // namespace ramus::app
