// Commands for the look of defocused branches.
#include "app/actions/arguments.h"
#include "app/actions/groups.h"

namespace ramus::app::actions {

namespace {

Result<void> glass_opacity(ActionContext& context, Arguments arguments) {
    const auto value = arguments.size() == 1 ? number_in(arguments[0], 0.0, 2.0) : std::nullopt;
    if (!value) return fail("glass-opacity takes a number from 0 to 2", {}, "0 leaves the centerlines, 1 is the usual");
    return edit(context, [&](Marks& marks) { marks.glass.opacity = *value; });
}

Result<void> glass_grey(ActionContext& context, Arguments arguments) {
    const auto value = arguments.size() == 1 ? number_in(arguments[0], 0.0, 1.0) : std::nullopt;
    if (!value) return fail("glass-grey takes a number from 0 to 1", {}, "0 is black, 1 white, 0.7 the usual");
    return edit(context, [&](Marks& marks) { marks.glass.grey = *value; });
}

} // namespace

std::vector<Command> glass_commands() {
    return {
        Command("glass-opacity", "V",
                "How dense defocused branches are: 0 leaves their centerlines, 1 is the usual veil, 2 nearly solid.",
                glass_opacity),
        Command("glass-grey", "V", "The grey of defocused branches, from 0 (black) to 1 (white).", glass_grey),
    };
}

} // namespace ramus::app::actions
