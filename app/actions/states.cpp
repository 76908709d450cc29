// Commands for states and names of the selected branches.
#include "app/actions/arguments.h"
#include "app/actions/groups.h"
#include "app/session/labels.h"

#include <algorithm>
#include <iterator>
#include <vector>

namespace ramus::app::actions {

namespace {

using tree::BranchState;

std::vector<int> in_both(const std::vector<int>& a, const std::vector<int>& b) { // both ascending
    std::vector<int> both;
    std::ranges::set_intersection(a, b, std::back_inserter(both));
    return both;
}

CommandAction setting(BranchState state) {
    return [state](ActionContext& context, Arguments) -> Result<void> {
        if (auto some = expect_selection(context.document); !some) return some;
        return edit(context, [&](Marks& marks) { set_state(marks, marks.selection, state); });
    };
}

Result<void> defocus_others(ActionContext& context, Arguments) {
    if (auto some = expect_selection(context.document); !some) return some;
    return edit(context, [&](Marks& marks) {
        set_state(marks, unselected(context.document), BranchState::kDefocused);
        // Selected branches that were defocused become visible.
        set_state(marks, in_both(marks.selection, branches_in_state(marks, BranchState::kDefocused)),
                  BranchState::kNormal);
    });
}

// Makes all branches in this state normal.
CommandAction ending(BranchState state) {
    return [state](ActionContext& context, Arguments) -> Result<void> {
        return edit(context, [&](Marks& marks) {
            const std::vector<int> ids = branches_in_state(marks, state);
            set_state(marks, ids, BranchState::kNormal);
        });
    };
}

Result<void> show_all(ActionContext& context, Arguments) {
    return edit(context, [&](Marks& marks) { marks.states.clear(); });
}

Result<void> name(ActionContext& context, Arguments arguments) {
    const bool of_subtree = arguments.size() == 3 && arguments[2] == "subtree";
    if (arguments.size() != 2 && !of_subtree)
        return fail("name takes a branch id and a text, and subtree where what depends on it is called so too", {},
                    "put quotes around a text with blanks");
    RAMUS_TRY(id, branch_id(context.document, arguments[0]));
    return edit(context, [&, id = id](Marks& marks) { set_name(marks, id, arguments[1], of_subtree); });
}

template <BranchState state> bool has_any(const Document& document) {
    return std::ranges::find(document.marks().states, state) != document.marks().states.end();
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
        Command("show-hidden", "", "Makes the hidden branches normal again.", ending(BranchState::kHidden))
            .in_menu("Branches", "Show hidden")
            .when(has_any<BranchState::kHidden>),
        Command("focus-all", "", "Makes the defocused branches, those of grey glass, normal again.",
                ending(BranchState::kDefocused))
            .in_menu("Branches", "Focus all")
            .when(has_any<BranchState::kDefocused>),
        Command("show-all", "", "Makes every branch normal again.", show_all)
            .in_menu("Branches", "Show all", {"Shift+N"})
            .when(has_states),
        Command("name", "ID TEXT [subtree]",
                "Gives a branch a name, with subtree also to what depends on it; an empty one takes it away.", name),
    };
}

} // namespace ramus::app::actions
