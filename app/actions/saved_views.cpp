// Commands of saved views. Going to one is no step of undo; saving, renaming and deleting are.
#include "app/actions/arguments.h"
#include "app/actions/groups.h"

#include <iterator>

namespace ramus::app::actions {

namespace {

constexpr const char* kQuotes = "put quotes around a name with blanks";

Result<std::size_t> view_in(const ActionContext& context, const std::string& name) {
    return find_view(context.document.marks().views, name);
}

// Without a name the window asks for it.
Result<void> view_save(ActionContext& context, Arguments arguments) {
    if (arguments.empty() && context.window != nullptr) {
        context.window->ask_for_view_name({});
        return {};
    }
    if (arguments.size() != 1) return fail("view-save takes a name", {}, kQuotes);
    const std::string& name = arguments[0];
    if (auto good = check_view_name(name); !good) return good;
    const bool replaces = has_view(context.document.marks().views, name);
    auto saved = edit(context, [&](Marks& marks) { save_view(marks.views, name, context.document.session().camera); });
    if (saved) context.say((replaces ? "Saved view replaced: " : "View saved: ") + name);
    return saved;
}

Result<void> view_go(ActionContext& context, Arguments arguments) {
    if (arguments.size() != 1) return fail("view-go takes the name of a saved view", {}, kQuotes);
    RAMUS_TRY(view, view_in(context, arguments[0]));
    return move_camera(context, context.document.marks().views[view].camera);
}

Result<void> view_rename(ActionContext& context, Arguments arguments) {
    const bool asks = arguments.size() == 1 && context.window != nullptr;
    if (arguments.size() != 2 && !asks)
        return fail("view-rename takes the name of a saved view and its new name", {}, kQuotes);
    RAMUS_TRY(view, view_in(context, arguments[0]));
    if (asks) {
        context.window->ask_for_view_name(arguments[0]);
        return {};
    }
    const std::string& name = arguments[1];
    if (auto good = check_view_name(name); !good) return good;
    if (name != arguments[0] && has_view(context.document.marks().views, name))
        return fail("there is a saved view \"" + name + "\" already", {}, "give this one another name");
    return edit(context, [&, view = view](Marks& marks) { marks.views[view].name = name; });
}

Result<void> view_delete(ActionContext& context, Arguments arguments) {
    if (arguments.size() != 1) return fail("view-delete takes the name of a saved view", {}, kQuotes);
    RAMUS_TRY(view, view_in(context, arguments[0]));
    return edit(context, [view = view](Marks& marks) {
        marks.views.erase(std::next(marks.views.begin(), static_cast<std::ptrdiff_t>(view)));
    });
}

bool has_views(const Document& document) { return !document.marks().views.empty(); }

} // namespace

std::vector<Command> saved_view_commands() {
    return {
        Command("view-save", "[NAME]",
                "Saves the view as it is under a name; one that has the name already is replaced. Without a name, the "
                "window asks for it.",
                view_save)
            .in_menu("View", "Save this view...", {"Ctrl+D"})
            .when(has_scene),
        Command("view-go", "NAME", "Looks from a saved view.", view_go).when(has_views),
        Command("view-rename", "NAME [NEW]",
                "Gives a saved view another name. Without a new name, the window asks for it.", view_rename)
            .when(has_views),
        Command("view-delete", "NAME", "Deletes a saved view.", view_delete).when(has_views),
    };
}

} // namespace ramus::app::actions
