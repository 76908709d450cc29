// Trees, sessions and pictures; the window itself.
#include "app/actions/arguments.h"
#include "app/actions/groups.h"
#include "app/session_file.h"

namespace ramus::app::actions {

namespace {

Result<void> open(ActionContext& context, Arguments arguments) {
    if (arguments.size() > 1) return fail("open takes one file", {}, "put quotes around a name with blanks");
    return arguments.empty() ? context.host.ask_for_file() : context.host.open(arguments[0]);
}

Result<void> save(ActionContext& context, Arguments arguments) {
    const auto path = file_argument(context, arguments, "save", ".ramus.json");
    if (!path) return tl::unexpected(path.error());
    if (auto written = write_session(context.document.session(), *path); !written) return written;
    context.document.mark_saved(std::filesystem::absolute(*path).lexically_normal());
    context.host.say("Session saved: " + path->string());
    return {};
}

Result<void> shot(ActionContext& context, Arguments arguments) {
    const auto path = file_argument(context, arguments, "shot", ".png");
    if (!path) return tl::unexpected(path.error());
    if (auto written = context.host.write_picture(*path); !written) return written;
    context.host.say("Picture saved: " + path->string());
    return {};
}

Result<void> quit(ActionContext& context, Arguments) { return context.host.quit(); }

Result<void> panel(ActionContext& context, Arguments arguments) {
    if (arguments.empty()) return context.host.toggle("panel");
    if (arguments.size() > 1 || (arguments[0] != "explore" && arguments[0] != "plan" && arguments[0] != "other"))
        return fail("panel shows or hides itself, or one of its halves", {}, "panel, panel explore or panel plan");
    return context.host.toggle(arguments[0]);
}

Result<void> help(ActionContext& context, Arguments) { return context.host.toggle("help"); }

} // namespace

std::vector<Command> file_commands() {
    return {
        {"open",
         "[FILE]",
         "Opens a tree or a session; without FILE, asks for one.",
         "File",
         "Open...",
         {"Ctrl+O"},
         open},
        {"save",
         "[FILE]",
         "Writes the session: what is selected, hidden and highlighted, the camera, the options.",
         "File",
         "Save session",
         {"Ctrl+S"},
         save,
         {},
         has_tree},
        {"shot", "[FILE]", "Writes the picture as PNG.", "File", "Save picture", {"F12"}, shot, {}, has_tree},
        {"quit", "", "Closes ramus.", "File", "Quit", {"Ctrl+Q"}, quit},
    };
}

std::vector<Command> window_commands() {
    return {
        {"panel",
         "[explore|plan]",
         "Shows or hides the side panel, or shows the half of it that explores or the one that plans.",
         "View",
         "Side panel",
         {"Tab"},
         panel},
        {"panel",
         "[explore|plan]",
         "Goes from the exploring half of the side panel to the planning half, and back.",
         "View",
         "Explore or plan",
         {"B"},
         panel,
         {"other"},
         has_tree},
        {"help", "", "Shows what the mouse and the keys do.", "Help", "Mouse and keys", {"F1", "?"}, help},
    };
}

} // namespace ramus::app::actions
