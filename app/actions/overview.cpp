// The flat picture of the tree beside the other one.
#include "app/actions/arguments.h"
#include "app/actions/groups.h"

#include <algorithm>
#include <array>

namespace ramus::app::actions {

namespace {

Result<void> overview(ActionContext& context, Arguments arguments) {
    constexpr std::array<std::string_view, 4> kSettings{"on", "off", "generation", "distance"};
    if (arguments.size() > 1 ||
        (arguments.size() == 1 && std::ranges::find(kSettings, arguments[0]) == kSettings.end()))
        return fail("overview is on, off, or by generation or distance");
    return arguments.empty() ? context.host.toggle("overview") : context.host.arrange("overview", arguments[0]);
}

bool shows_overview(Host& host, const Command&) { return host.shows("overview"); }

} // namespace

std::vector<Command> overview_commands() {
    Command entry{"overview",
                  "[on|off|generation|distance]",
                  "Shows or hides the tree as a flat picture: generation or distance from the root downwards.",
                  "View",
                  "Overview",
                  {"T"},
                  overview};
    entry.in_use = shows_overview;
    return {entry};
}

} // namespace ramus::app::actions
