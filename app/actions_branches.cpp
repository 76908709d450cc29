// Selecting branches and giving them states.
#include "app/actions.h"

#include <algorithm>
#include <charconv>
#include <iterator>
#include <numeric>

namespace ramus::app::actions {

namespace {

using render::BranchState;

Result<int> branch_id(const Document& document, const std::string& word) {
    int id = -1;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), id);
    if (error != std::errc{} || end != word.data() + word.size()) return fail("\"" + word + "\" is not a branch id");
    if (id < 0 || id >= document.branch_count())
        return fail("there is no branch " + word, {},
                    "ids go from 0 to " + std::to_string(document.branch_count() - 1) + " in this tree");
    return id;
}

Result<std::vector<int>> branch_ids(const Document& document, Arguments arguments) {
    if (arguments.empty()) return fail("which branches?", {}, "give their ids");
    std::vector<int> ids;
    for (const std::string& word : arguments) {
        const auto id = branch_id(document, word);
        if (!id) return tl::unexpected(id.error());
        ids.push_back(*id);
    }
    return ids;
}

void select_these(Document& document, std::vector<int> ids) {
    Marks next = document.marks();
    next.selection = canonical(std::move(ids));
    document.change(std::move(next));
}

// Every branch is visited once: subtree() of each of them would cost their product.
std::vector<int> with_dependents(const Document& document, std::vector<int> open) {
    std::vector<char> found(static_cast<std::size_t>(document.branch_count()), 0);
    std::vector<int> ids;
    while (!open.empty()) {
        const int id = open.back();
        open.pop_back();
        if (std::exchange(found[static_cast<std::size_t>(id)], 1) != 0) continue;
        ids.push_back(id);
        const auto& children = document.tree()->branches[static_cast<std::size_t>(id)].children;
        open.insert(open.end(), children.begin(), children.end());
    }
    return ids;
}

std::vector<int> everything(const Document& document) {
    std::vector<int> all(static_cast<std::size_t>(document.branch_count()));
    std::iota(all.begin(), all.end(), 0);
    return all;
}

std::vector<int> unselected(const Document& document) {
    std::vector<int> rest = everything(document);
    std::erase_if(rest, [&](int id) { return is_selected(document.marks(), id); });
    return rest;
}

Result<void> set_selected(Document& document, BranchState state) {
    if (document.marks().selection.empty()) return fail("nothing is selected", {}, "select branches first");
    Marks next = document.marks();
    set_state(next, next.selection, state);
    document.change(std::move(next));
    return {};
}

} // namespace

Result<void> select(ActionContext& context, Arguments arguments) {
    auto ids = branch_ids(context.document, arguments);
    if (!ids) return tl::unexpected(ids.error());
    select_these(context.document, std::move(*ids));
    return {};
}

Result<void> select_add(ActionContext& context, Arguments arguments) {
    auto ids = branch_ids(context.document, arguments);
    if (!ids) return tl::unexpected(ids.error());
    ids->insert(ids->end(), context.document.marks().selection.begin(), context.document.marks().selection.end());
    select_these(context.document, std::move(*ids));
    return {};
}

Result<void> select_subtree(ActionContext& context, Arguments arguments) {
    const auto ids = branch_ids(context.document, arguments);
    if (!ids) return tl::unexpected(ids.error());
    select_these(context.document, with_dependents(context.document, *ids));
    return {};
}

Result<void> select_toggle(ActionContext& context, Arguments arguments) {
    const auto ids = branch_ids(context.document, arguments);
    if (!ids) return tl::unexpected(ids.error());
    std::vector<int> next;
    const std::vector<int> toggled = canonical(*ids);
    std::ranges::set_symmetric_difference(context.document.marks().selection, toggled, std::back_inserter(next));
    select_these(context.document, std::move(next));
    return {};
}

Result<void> select_none(ActionContext& context, Arguments) {
    select_these(context.document, {});
    return {};
}

Result<void> select_dependents(ActionContext& context, Arguments) {
    select_these(context.document, with_dependents(context.document, context.document.marks().selection));
    return {};
}

Result<void> select_upstream(ActionContext& context, Arguments) {
    std::vector<char> found(static_cast<std::size_t>(context.document.branch_count()), 0);
    std::vector<int> ids;
    for (int id : context.document.marks().selection)
        for (; id != tree::kNoBranch && std::exchange(found[static_cast<std::size_t>(id)], 1) == 0;
             id = context.document.tree()->branches[static_cast<std::size_t>(id)].parent)
            ids.push_back(id);
    select_these(context.document, std::move(ids));
    return {};
}

Result<void> select_invert(ActionContext& context, Arguments) {
    select_these(context.document, unselected(context.document));
    return {};
}

Result<void> dismiss(ActionContext& context, Arguments arguments) {
    return context.host.dismiss() ? Result<void>{} : select_none(context, arguments);
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
    if (context.document.marks().selection.empty()) return fail("nothing is selected", {}, "select branches first");
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

} // namespace ramus::app::actions
