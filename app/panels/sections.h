// The sections of the side panel's pages, one file each. Each draws nothing where it has nothing to say. A new section
// is its file, a declaration here and a row in side_panel.cpp.
#pragma once

#include "app/panels/interface.h"

namespace ramus::app {

void draw_systems(InterfaceContext& context);
void draw_glass(InterfaceContext& context);
void draw_context(InterfaceContext& context);
void draw_compare(InterfaceContext& context);
void draw_colours(InterfaceContext& context);   // while colours say a quantity, or data could be said
void draw_deviation(InterfaceContext& context); // while colours say it
void draw_measurements(InterfaceContext& context);
void draw_lesions(InterfaceContext& context); // and the vessels nearest to each
void draw_margins(InterfaceContext& context); // and the branches within them
void draw_cuts(InterfaceContext& context);
void draw_thin_vessels(InterfaceContext& context);
void draw_report_button(InterfaceContext& context);

} // namespace ramus::app
