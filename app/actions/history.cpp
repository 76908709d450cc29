// Commands undo and redo.
#include "app/actions/arguments.h"
#include "app/actions/groups.h"
#include "app/session/numbers.h"

namespace ramus::app::actions {

namespace {

// The number of steps in the arguments; `there`: how many are available.
Result<std::size_t> steps(Arguments arguments, std::size_t there, const std::string& verb) {
    if (there == 0) return fail("there is nothing to " + verb);
    if (arguments.empty()) return 1;
    const auto wanted = arguments.size() == 1 ? number_in(arguments[0], 1.0, 1e9) : std::nullopt;
    if (!wanted || *wanted != static_cast<double>(static_cast<std::size_t>(*wanted)))
        return fail(verb + " takes a number of steps");
    if (*wanted > static_cast<double>(there))
        return fail("there " + std::string(there == 1 ? "is" : "are") + " only " + counted(there, "step", "steps") +
                    " to " + verb);
    return static_cast<std::size_t>(*wanted);
}

Result<void> walk(ActionContext& context, Arguments arguments, std::size_t there, const std::string& verb) {
    RAMUS_TRY(wanted, steps(arguments, there, verb));
    const render::Camera before = context.document.session().camera;
    while (wanted-- > 0) verb == "undo" ? context.document.undo() : context.document.redo();
    if (context.document.session().camera != before) context.picture.camera_leapt();
    return {};
}

Result<void> undo(ActionContext& context, Arguments arguments) {
    return walk(context, arguments, context.document.position(), "undo");
}

Result<void> redo(ActionContext& context, Arguments arguments) {
    return walk(context, arguments, context.document.step_count() - context.document.position(), "redo");
}

bool can_undo(const Document& document) { return document.can_undo(); }
bool can_redo(const Document& document) { return document.can_redo(); }

std::string undo_label(const Document& document) {
    return document.can_undo() ? "Undo " + document.step_name(document.position() - 1) : "Undo";
}

std::string redo_label(const Document& document) {
    return document.can_redo() ? "Redo " + document.step_name(document.position()) : "Redo";
}

} // namespace

std::vector<Command> history_commands() {
    return {
        Command("undo", "[N]", "Takes the last change back, or the last N.", undo)
            .in_menu("Edit", "Undo", {"Ctrl+Z"})
            .when(can_undo)
            .labelled(undo_label),
        Command("redo", "[N]", "Makes the change that was taken back again, or N of them.", redo)
            .in_menu("Edit", "Redo", {"Ctrl+Shift+Z", "Ctrl+Y"})
            .when(can_redo)
            .labelled(redo_label),
    };
}

} // namespace ramus::app::actions
