// The lines and labels that a session's marks put into the picture: a hoop around every cut, and what was measured.
#pragma once

#include "app/plan.h"
#include "app/session.h"
#include "render/frame.h"

namespace ramus::app {

// Adds them to `frame`, whose centerlines are those of `tree`. `plan`: of the same marks; null: as without cuts.
void draw_marks(render::Frame& frame, const tree::VesselTree& tree, const Marks& marks, const Plan* plan);

} // namespace ramus::app
