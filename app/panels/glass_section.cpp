// The section for the look of defocused branches; shown while any branch is defocused.
#include "app/panels/editing.h"
#include "app/panels/sections.h"
#include "app/session/numbers.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace ramus::app {

void draw_glass(InterfaceContext& context) {
    const Marks& marks = context.workspace.document().marks();
    context.interface.tried_glass.reset();
    if (std::ranges::find(marks.states, tree::BranchState::kDefocused) == marks.states.end()) return;
    widgets::section("Glass");
    widgets::Slider<float>& opacity = context.interface.of<Editing>().glass_opacity;
    widgets::Slider<float>& grey = context.interface.of<Editing>().glass_grey;
    const bool opacity_changed =
        widgets::share_row("Opacity", "0 leaves the centerlines of defocused branches, 200 % is nearly solid", opacity,
                           marks.glass.opacity, 2.0F);
    const bool grey_changed = widgets::share_row("Grey", "From black to white", grey, marks.glass.grey);
    if (opacity.held || grey.held)
        context.interface.tried_glass =
            GlassLook{opacity.held ? opacity.value : marks.glass.opacity, grey.held ? grey.value : marks.glass.grey};
    if (opacity_changed) context.perform("glass-opacity", {digits(opacity.value, 3)});
    if (grey_changed) context.perform("glass-grey", {digits(grey.value, 3)});
}

} // namespace ramus::app
