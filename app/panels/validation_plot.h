// The radius along a branch in the validation's panel: as it was read, of the surface, of the truncated cones, and of a
// mask's isosurface where there is one.
#pragma once

#include "app/assets/validation.h"
#include "app/session/document.h"

namespace ramus::app {

// `fits`: the validation is of the tree and options as they are; else the branch may be another one.
void draw_radius_plot(const Document& document, const TreeValidation& validation, bool fits, int current_finding);

} // namespace ramus::app
