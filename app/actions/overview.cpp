// Commands of the overview panel, and of the name field.
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
    if (arguments.empty()) return toggle_part(context, "overview");
    if (context.window == nullptr) return no_window("overview");
    context.window->set_overview(arguments[0]);
    return {};
}

// The main branch of the selection: the only one, or the one on which all others depend.
int stem_of_selection(const Document& document) {
    const auto& selection = document.marks().selection;
    const tree::Dependency& dependency = document.dependency();
    int stem = selection.front();
    for (const int id : selection)
        if (dependency.depends(stem, id)) stem = id;
    const bool all = std::ranges::all_of(selection, [&](int id) { return id == stem || dependency.depends(id, stem); });
    return all ? stem : tree::kNoBranch;
}

Result<void> rename(ActionContext& context, Arguments arguments) {
    if (arguments.size() > 1) return fail("rename takes the id of one branch");
    int branch = tree::kNoBranch;
    if (!arguments.empty()) {
        RAMUS_TRY(id, branch_id(context.document, arguments[0]));
        branch = id;
    } else {
        if (auto some = expect_selection(context.document); !some) return some;
        branch = stem_of_selection(context.document);
        if (branch == tree::kNoBranch)
            return fail("a name is given to one branch", {}, "select one, or one with all that depends on it");
    }
    if (context.window == nullptr) return no_window("name");
    context.window->ask_for_name(branch);
    return {};
}

} // namespace

std::vector<Command> overview_commands() {
    return {
        Command("overview", "[on|off|generation|distance]",
                "Shows or hides the tree as a flat picture: generation or distance from the root downwards.", overview)
            .in_menu("View", "Overview", {"T"})
            .in_submenu("Panels")
            .in_use_when(shows_part("overview")),
        Command("rename", "[ID]", "Asks for the name of the selected branch, or of it and all that depends on it.",
                rename)
            .in_menu("Branches", "Name...", {"F2"})
            .when(has_selection),
    };
}

} // namespace ramus::app::actions
