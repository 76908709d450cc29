// Plots the radius along a branch in the validation panel: of the tree, of the surface, of the truncated cones, and of
// a mask's isosurface if there is one.
#pragma once

#include "app/assets/validation.h"
#include "app/session/document.h"

namespace ramus::app {

// `fits`: the validation belongs to the current tree and options; otherwise its branch ids may be outdated.
void draw_radius_plot(const Document& document, const TreeValidation& validation, bool fits, int current_finding);

} // namespace ramus::app
