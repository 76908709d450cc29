// What becomes of the selected branches, and their names.
#include "app/actions/arguments.h"
#include "app/actions/groups.h"

namespace ramus::app::actions {

namespace {

using render::BranchState;

Result<void> set_selected(Document& document, BranchState state) {
    if (auto some = expect_selection(document); !some) return some;
    Marks next = document.marks();
    set_state(next, next.selection, state);
    document.change(std::move(next));
    return {};
}

Result<void> highlight(ActionContext& context, Arguments) {
    return set_selected(context.document, BranchState::kHighlighted);
}

Result<void> defocus(ActionContext& context, Arguments) {
    return set_selected(context.document, BranchState::kDefocused);
}

Result<void> hide(ActionContext& context, Arguments) { return set_selected(context.document, BranchState::kHidden); }

Result<void> show(ActionContext& context, Arguments) { return set_selected(context.document, BranchState::kNormal); }

Result<void> defocus_others(ActionContext& context, Arguments) {
    if (auto some = expect_selection(context.document); !some) return some;
    Marks next = context.document.marks();
    set_state(next, unselected(context.document), BranchState::kDefocused);
    context.document.change(std::move(next));
    return {};
}

Result<void> show_all(ActionContext& context, Arguments) {
    Marks next = context.document.marks();
    next.states.clear();
    context.document.change(std::move(next));
    return {};
}

Result<void> name(ActionContext& context, Arguments arguments) {
    if (arguments.size() != 2)
        return fail("name takes a branch id and a text", {}, "put quotes around a text with blanks");
    const auto id = branch_id(context.document, arguments[0]);
    if (!id) return tl::unexpected(id.error());
    Marks next = context.document.marks();
    if (arguments[1].empty())
        next.names.erase(*id);
    else
        next.names[*id] = arguments[1];
    context.document.change(std::move(next));
    return {};
}

bool has_states(const Document& document) { return !document.marks().states.empty(); }

} // namespace

std::vector<Command> state_commands() {
    return {
        {"highlight",
         "",
         "Highlights the selected branches.",
         "Branches",
         "Highlight",
         {"H"},
         highlight,
         {},
         has_selection},
        {"defocus",
         "",
         "Makes the selected branches grey glass.",
         "Branches",
         "Defocus",
         {"G"},
         defocus,
         {},
         has_selection},
        {"defocus-others",
         "",
         "Makes everything but the selected branches grey glass.",
         "Branches",
         "Defocus others",
         {"Shift+G"},
         defocus_others,
         {},
         has_selection},
        {"hide", "", "Hides the selected branches.", "Branches", "Hide", {"X", "Delete"}, hide, {}, has_selection},
        {"show",
         "",
         "Makes the selected branches normal again.",
         "Branches",
         "Show normally",
         {"N"},
         show,
         {},
         has_selection},
        {"show-all",
         "",
         "Makes every branch normal again.",
         "Branches",
         "Show all",
         {"Shift+N"},
         show_all,
         {},
         has_states},
        {"name", "ID TEXT", "Gives a branch a name; an empty one takes it away.", "", "", {}, name},
    };
}

} // namespace ramus::app::actions
