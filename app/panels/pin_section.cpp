// The pins of the planning page.
#include "app/panels/plan_rows.h"
#include "app/panels/sections.h"
#include "app/panels/widgets.h"

namespace ramus::app {

void draw_pins(InterfaceContext& context) {
    if (!draw_section(context, "Pins", {{"Pin", "Pin a text to a place of a vessel", "tool", {"pin"}}})) return;
    const std::vector<Pin> pins = context.workspace.document().marks().pins; // a copy: rows change the list
    for (std::size_t i = 0; i < pins.size(); ++i)
        plan_rows::object_row(context, plan_rows::row_of(context, pins[i], i));
}

} // namespace ramus::app
