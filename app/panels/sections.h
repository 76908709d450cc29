// The sections of the side panel's pages. A section without content draws nothing. To add one: a file, a declaration
// and a row here.
#pragma once

#include "app/panels/interface.h"

namespace ramus::app {

void draw_systems(InterfaceContext& context);
void draw_explore(InterfaceContext& context); // systems, the selection and the branches
void draw_surface(InterfaceContext& context);
void draw_surface_problem(InterfaceContext& context);
void draw_glass(InterfaceContext& context);
void draw_context(InterfaceContext& context);
void draw_compare(InterfaceContext& context);
void draw_colours(InterfaceContext& context);   // while a quantity is coloured, or data are available
void draw_deviation(InterfaceContext& context); // while deviation is coloured
void draw_measurements(InterfaceContext& context);
void draw_pins(InterfaceContext& context);
void draw_saved_views(InterfaceContext& context);
void draw_slices(InterfaceContext& context);  // and their scans
void draw_region(InterfaceContext& context);  // that is grown in a scan
void draw_along(InterfaceContext& context);   // and the figures of its sections
void draw_lesions(InterfaceContext& context); // and the vessels nearest to each
void draw_margins(InterfaceContext& context); // and the branches within them
void draw_cuts(InterfaceContext& context);
void draw_organ(InterfaceContext& context);      // and what the cuts leave of it
void draw_plans(InterfaceContext& context);      // and their figures side by side
void draw_resections(InterfaceContext& context); // and the vessels they cut
void draw_thin_vessels(InterfaceContext& context);
void draw_report_button(InterfaceContext& context);

// In the order of the page.
struct Section {
    PanelPage page;
    void (*draw)(InterfaceContext& context);
};
inline constexpr Section kSections[] = {
    {PanelPage::kExplore, draw_explore},
    {PanelPage::kSurface, draw_colours},
    {PanelPage::kSurface, draw_deviation}, // colours before the surface that they apply to
    {PanelPage::kSurface, draw_surface},
    {PanelPage::kSurface, draw_glass},
    {PanelPage::kSurface, draw_context},
    {PanelPage::kSurface, draw_compare},
    {PanelPage::kSurface, draw_surface_problem},
    {PanelPage::kSlices, draw_slices},
    {PanelPage::kSlices, draw_along},
    {PanelPage::kSlices, draw_region},
    {PanelPage::kPlan, draw_measurements}, // first: sections below grow, the tools stay in place
    {PanelPage::kPlan, draw_lesions},
    {PanelPage::kPlan, draw_margins},
    {PanelPage::kPlan, draw_cuts},
    {PanelPage::kPlan, draw_organ},
    {PanelPage::kPlan, draw_resections},
    {PanelPage::kPlan, draw_plans},
    {PanelPage::kPlan, draw_pins},
    {PanelPage::kPlan, draw_saved_views},
    {PanelPage::kPlan, draw_thin_vessels},
    {PanelPage::kPlan, draw_report_button},
};

} // namespace ramus::app
