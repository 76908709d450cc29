// The panel over the picture's left edge, of which there is one at a time: the import doctor, the list of contacts, or
// the validation.
#pragma once

#include "app/panels/interface.h"

namespace ramus::app {

// Below the tools and the heading, above the scale bar and the cube, as high as it needs to be. Where surfaces stand
// side by side it lies over the isosurface, for the tree is what is looked at. ImGui::End() ends it. Returns how far
// down its content can reach without being scrolled, in pixels of the window.
float begin_left_panel(const char* name, InterfaceContext& context);

} // namespace ramus::app
