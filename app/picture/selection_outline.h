// The outline of selected vessels where others hide them: two lines along each, a radius to either side of the
// centerline as the eye sees it. The picture shows them only where something that is not selected lies before them
// (render::MarkLine::of_selection). Of so many points at the most: the branches with the largest radii come first.
#pragma once

#include "render/scene/frame.h"

namespace ramus::app {

// `frame` has its camera, states, selection and centerlines.
void outline_selection(render::Frame& frame, const tree::VesselTree& tree);

} // namespace ramus::app
