// Pins: texts at places. objects.cpp shows, names and removes them.
#include "app/actions/arguments.h"
#include "app/actions/groups.h"

namespace ramus::app::actions {

namespace {

std::optional<glm::dvec3> pin_place(const std::string& word) {
    const auto numbers = numbers_in(word, 3, kFarthestMm);
    return numbers ? std::optional(glm::dvec3((*numbers)[0], (*numbers)[1], (*numbers)[2])) : std::nullopt;
}

// Without a text the window asks for it.
Result<void> pin(ActionContext& context, Arguments arguments) {
    const auto place = arguments.empty() || arguments.size() > 2 ? std::nullopt : pin_place(arguments[0]);
    if (!place) return fail("pin takes X,Y,Z in mm and a text", {}, "put quotes around a text with blanks");
    auto added = edit(context, [&](Marks& marks) {
        marks.pins.push_back({.at = *place, .name = arguments.size() == 2 ? arguments[1] : std::string()});
    });
    if (added && arguments.size() == 1 && context.window != nullptr)
        context.window->ask_for_object_name("pin", std::to_string(context.document.marks().pins.size()), "");
    return added;
}

Result<void> pin_move(ActionContext& context, Arguments arguments) {
    const auto place = arguments.size() == 2 ? pin_place(arguments[1]) : std::nullopt;
    if (!place) return fail("pin-move takes a pin's number and X,Y,Z in mm");
    RAMUS_TRY(index, list_index(arguments.first(1), context.document.marks().pins.size(), "pin"));
    return edit(context, [&, index = index](Marks& marks) { marks.pins[index].at = *place; });
}

bool has_pins(const Document& document) { return !document.marks().pins.empty(); }

} // namespace

std::vector<Command> pin_commands() {
    return {
        Command("pin", "X,Y,Z [TEXT]", "Pins a text to a place; without a text, the window asks for it.", pin)
            .when(has_scene),
        Command("pin-move", "N X,Y,Z", "Moves pin N to another place.", pin_move).when(has_pins),
    };
}

} // namespace ramus::app::actions
