// The lines and labels that a session's marks put into the picture: a ring around every cut, and what was measured.
#pragma once

#include "app/assets/measured.h"
#include "app/assets/plan.h"
#include "app/session/session.h"
#include "render/scene/frame.h"

#include <span>

namespace ramus::app {

// Nothing without `frame`'s centerlines. `plan`: of the same marks; null: no vessel need be reconstructed.
void draw_cuts(render::Frame& frame, const Marks& marks, const Plan* plan);

// What could not be measured is left out.
void draw_measurements(render::Frame& frame, std::span<const Result<Measured>> measurements);

} // namespace ramus::app
