// The pins of the planning page.
#include "app/panels/plan_rows.h"
#include "app/panels/sections.h"
#include "app/panels/widgets.h"
#include "app/tools/spelling.h"

namespace ramus::app {

void draw_pins(InterfaceContext& context) {
    draw_title(context, "Pins", {{"Pin", "Pin a text to a place of a vessel", "tool", {"pin"}}});
    const std::vector<Pin> pins = context.workspace.document().marks().pins; // a copy: rows change the list
    for (std::size_t i = 0; i < pins.size(); ++i)
        if (plan_rows::object_row(context, pins[i], i,
                                  {"Pin " + std::to_string(i + 1),
                                   "Click to bring it to the middle of the picture, double-click to write"}))
            context.perform("centre", {spelled(pins[i].at)});
}

} // namespace ramus::app
