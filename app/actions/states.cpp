// What becomes of the selected branches, and their names.
#include "app/actions/arguments.h"
#include "app/actions/groups.h"

namespace ramus::app::actions {

namespace {

using render::BranchState;

CommandAction setting(BranchState state) {
    return [state](ActionContext& context, Arguments) -> Result<void> {
        if (auto some = expect_selection(context.document); !some) return some;
        return edit(context, [&](Marks& marks) { set_state(marks, marks.selection, state); });
    };
}

Result<void> defocus_others(ActionContext& context, Arguments) {
    if (auto some = expect_selection(context.document); !some) return some;
    return edit(context,
                [&](Marks& marks) { set_state(marks, unselected(context.document), BranchState::kDefocused); });
}

Result<void> show_all(ActionContext& context, Arguments) {
    return edit(context, [&](Marks& marks) { marks.states.clear(); });
}

Result<void> name(ActionContext& context, Arguments arguments) {
    if (arguments.size() != 2)
        return fail("name takes a branch id and a text", {}, "put quotes around a text with blanks");
    RAMUS_TRY(id, branch_id(context.document, arguments[0]));
    Marks next = context.document.marks();
    if (arguments[1].empty())
        next.names.erase(id);
    else
        next.names[id] = arguments[1];
    context.document.change(std::move(next));
    return {};
}

bool has_states(const Document& document) { return !document.marks().states.empty(); }

} // namespace

std::vector<Command> state_commands() {
    return {
        Command("highlight", "", "Highlights the selected branches.", setting(BranchState::kHighlighted))
            .in_menu("Branches", "Highlight", {"H"})
            .when(has_selection),
        Command("defocus", "", "Makes the selected branches grey glass.", setting(BranchState::kDefocused))
            .in_menu("Branches", "Defocus", {"G"})
            .when(has_selection),
        Command("defocus-others", "", "Makes everything but the selected branches grey glass.", defocus_others)
            .in_menu("Branches", "Defocus others", {"Shift+G"})
            .when(has_selection),
        Command("hide", "", "Hides the selected branches.", setting(BranchState::kHidden))
            .in_menu("Branches", "Hide", {"X", "Delete"})
            .when(has_selection),
        Command("show", "", "Makes the selected branches normal again.", setting(BranchState::kNormal))
            .in_menu("Branches", "Show normally", {"N"})
            .when(has_selection),
        Command("show-all", "", "Makes every branch normal again.", show_all)
            .in_menu("Branches", "Show all", {"Shift+N"})
            .when(has_states),
        Command("name", "ID TEXT", "Gives a branch a name; an empty one takes it away.", name),
    };
}

} // namespace ramus::app::actions
