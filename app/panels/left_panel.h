// The panel over the left edge of the picture: the import doctor, the list of contacts, or the validation; one at a
// time.
#pragma once

#include "app/panels/interface.h"

namespace ramus::app {

// Begins the panel, between tools and heading above and scale bar and cube below, as high as its content. If surfaces
// are shown side by side, it covers the isosurface rather than the tree's surface. End with ImGui::End(). Returns the
// lowest position that content can have without scrolling, in pixels of the window.
float begin_left_panel(const char* name, InterfaceContext& context);

} // namespace ramus::app
