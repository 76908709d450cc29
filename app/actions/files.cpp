// Trees, sessions and pictures; the window itself.
#include "app/actions/arguments.h"
#include "app/actions/groups.h"
#include "app/session/session_file.h"
#include "app/storage/settings.h"

#include <algorithm>

namespace ramus::app::actions {

namespace {

Result<void> open(ActionContext& context, Arguments arguments) {
    if (arguments.size() > 1) return fail("open takes one file", {}, "put quotes around a name with blanks");
    if (!arguments.empty() && arguments[0].empty()) return fail("the name of a file is empty");
    return arguments.empty() ? context.host.ask_for_file() : context.host.open(arguments[0]);
}

Result<void> save(ActionContext& context, Arguments arguments) {
    if (!has_tree(context.document)) return fail("there is no tree to save a session of");
    const auto path = file_argument(context, arguments, "save", ".ramus.json");
    if (!path) return tl::unexpected(path.error());
    if (auto written = write_session(context.document.session(), *path); !written) return written;
    const std::filesystem::path full = std::filesystem::absolute(*path).lexically_normal();
    context.document.mark_saved(full);
    context.host.say("Session saved: " + full.string());
    return {};
}

Result<void> save_as(ActionContext& context, Arguments) { return context.host.ask_for_name(); }

Result<void> shot(ActionContext& context, Arguments arguments) {
    const auto path = file_argument(context, arguments, "shot", ".png");
    if (!path) return tl::unexpected(path.error());
    if (auto written = context.host.write_picture(*path); !written) return written;
    context.host.say("Picture saved: " + std::filesystem::absolute(*path).lexically_normal().string());
    return {};
}

// The number of an entry in the dialog, 1 and more; 0 for none.
Result<int> number_of_entry(Arguments arguments, const std::string& command) {
    if (arguments.empty()) return 0;
    const auto wanted = arguments.size() == 1 ? number_in(arguments[0], 1.0, 1e6) : std::nullopt;
    if (!wanted || *wanted != static_cast<int>(*wanted)) return fail(command + " takes the number of an entry");
    return static_cast<int>(*wanted);
}

Result<void> recover(ActionContext& context, Arguments arguments) {
    const auto which = number_of_entry(arguments, "recover");
    return which ? context.host.recover(*which) : tl::unexpected(which.error());
}

Result<void> discard_recovery(ActionContext& context, Arguments arguments) {
    const auto which = number_of_entry(arguments, "discard-recovery");
    if (!which) return tl::unexpected(which.error());
    return *which > 0 ? context.host.discard_recovery(*which) : fail("discard-recovery takes the number of an entry");
}

Result<void> ui_scale(ActionContext& context, Arguments arguments) {
    constexpr double kStep = 1.125;
    const auto refused = fail("ui-scale takes a factor from 0.5 to 4, larger, smaller or auto");
    if (arguments.size() != 1) return refused;
    const std::string& word = arguments[0];
    if (word == "auto") return context.host.set_ui_scale(0.0);
    const double now = context.host.ui_scale();
    if (word == "larger") return context.host.set_ui_scale(std::min(now * kStep, kMostUiScale));
    if (word == "smaller") return context.host.set_ui_scale(std::max(now / kStep, kLeastUiScale));
    const auto factor = number_in(word, kLeastUiScale, kMostUiScale);
    return factor ? context.host.set_ui_scale(*factor) : refused;
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
        {"save-as",
         "",
         "Asks where to write the session.",
         "File",
         "Save session as...",
         {"Ctrl+Shift+S"},
         save_as,
         {},
         has_tree},
        {"recover",
         "[N]",
         "Shows what is left of runs that did not end well, or brings the N-th of them back.",
         "File",
         "Recover...",
         {},
         recover},
        {"discard-recovery",
         "N",
         "Throws the N-th away of what is left of runs that did not end well.",
         "",
         "",
         {},
         discard_recovery},
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
        {"ui-scale",
         "FACTOR|larger|smaller|auto",
         "Sets how large text and panels are, in pixels per point; auto is what the display says.",
         "",
         "",
         {},
         ui_scale},
        {"ui-scale",
         "FACTOR|larger|smaller|auto",
         "Makes text and panels larger.",
         "View",
         "Larger interface",
         {},
         ui_scale,
         {"larger"}},
        {"ui-scale",
         "FACTOR|larger|smaller|auto",
         "Makes text and panels smaller.",
         "View",
         "Smaller interface",
         {},
         ui_scale,
         {"smaller"}},
        {"help", "", "Shows what the mouse and the keys do.", "Help", "Mouse and keys", {"F1", "?"}, help},
    };
}

} // namespace ramus::app::actions
