// Commands of the selection.
#include "app/actions/arguments.h"
#include "app/actions/groups.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace ramus::app::actions {

namespace {

Result<void> select(ActionContext& context, Arguments arguments) {
    RAMUS_TRY(ids, branch_ids(context.document, arguments));
    return select_these(context, std::move(ids));
}

Result<void> select_add(ActionContext& context, Arguments arguments) {
    RAMUS_TRY(ids, branch_ids(context.document, arguments));
    ids.insert(ids.end(), context.document.marks().selection.begin(), context.document.marks().selection.end());
    return select_these(context, std::move(ids));
}

Result<void> select_subtree(ActionContext& context, Arguments arguments) {
    RAMUS_TRY(ids, branch_ids(context.document, arguments));
    return select_these(context, context.document.dependency().with_dependents(ids));
}

Result<void> select_toggle(ActionContext& context, Arguments arguments) {
    RAMUS_TRY(ids, branch_ids(context.document, arguments));
    std::vector<int> next;
    const std::vector<int> toggled = canonical(ids);
    std::ranges::set_symmetric_difference(context.document.marks().selection, toggled, std::back_inserter(next));
    return select_these(context, std::move(next));
}

Result<void> select_none(ActionContext& context, Arguments) { return select_these(context, {}); }

Result<void> select_dependents(ActionContext& context, Arguments) {
    const Document& document = context.document;
    if (document.facts() && nothing_depends(*document.facts()))
        context.say("Nothing is known to depend on anything: each of these vessels has a root of its own");
    return select_these(context, document.dependency().with_dependents(document.marks().selection));
}

Result<void> select_upstream(ActionContext& context, Arguments) {
    std::vector<char> found(static_cast<std::size_t>(context.document.branch_count()), 0);
    std::vector<int> ids;
    for (int id : context.document.marks().selection)
        for (; id != tree::kNoBranch && std::exchange(found[static_cast<std::size_t>(id)], 1) == 0;
             id = context.document.tree()->branches[static_cast<std::size_t>(id)].parent)
            ids.push_back(id);
    return select_these(context, std::move(ids));
}

Result<void> select_invert(ActionContext& context, Arguments) {
    return select_these(context, unselected(context.document));
}

Result<void> dismiss(ActionContext& context, Arguments arguments) {
    return context.window != nullptr && context.window->dismiss() ? Result<void>{} : select_none(context, arguments);
}

} // namespace

std::vector<Command> selection_commands() {
    return {
        Command("select", "ID...", "Selects these branches and no others.", select),
        Command("select-add", "ID...", "Adds these branches to the selection.", select_add),
        Command("select-dependents", "", "Selects also all that depends on the selected branches.", select_dependents)
            .in_menu("Select", "Dependents", {"D"})
            .when(has_selection),
        Command("select-upstream", "", "Selects also the way from the selected branches to the root.", select_upstream)
            .in_menu("Select", "Upstream", {"U"})
            .when(has_selection),
        Command("select-invert", "", "Selects what is not selected, and nothing else.", select_invert)
            .in_menu("Select", "Invert", {"Ctrl+I"})
            .when(has_tree),
        Command("select-subtree", "ID...", "Selects these branches and all that depends on them, and no others.",
                select_subtree),
        Command("select-toggle", "ID...", "Takes each of these branches into the selection, or out of it.",
                select_toggle),
        Command("select-none", "", "Selects nothing.", select_none).in_menu("Select", "Nothing").when(has_selection),
        Command("dismiss", "", "Closes what lies on top; with nothing there, selects nothing.", dismiss)
            .on_keys({"Escape"}),
    };
}

} // namespace ramus::app::actions
