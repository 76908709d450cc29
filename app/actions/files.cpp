// Commands of files: trees, sessions and pictures; and of the window.
#include "app/actions/arguments.h"
#include "app/actions/groups.h"
#include "app/session/reading_options.h"
#include "app/session/session_file.h"
#include "app/storage/settings.h"
#include "core/base/child_program.h"
#include "core/io/run_inputs.h"

#include <algorithm>
#include <array>
#include <span>
#include <string_view>

namespace ramus::app::actions {

namespace {

Result<void> open(ActionContext& context, Arguments arguments) {
    const bool as_tree = arguments.size() > 1 && arguments[1] == "--tree";
    constexpr std::array<std::string_view, 5> kReading{"--labels", "--isovalue", "--radius", "--channel", "--time"};
    bool options = as_tree && arguments.size() % 2 == 0;
    for (std::size_t n = 2; options && n < arguments.size(); n += 2)
        options = std::ranges::find(kReading, arguments[n]) != kReading.end();
    if (arguments.size() > 1 && !options)
        return fail("open takes one file", {}, "put quotes around a name with blanks");
    if (!arguments.empty() && arguments[0].empty()) return fail("the name of a file is empty");
    if (arguments.empty()) return ask_for_file(context, FilePurpose::kOpen, fail("open needs a FILE here"));
    if (context.files == nullptr) return fail("a file cannot be opened from here", {}, "open it in a window");
    if (as_tree) {
        io::ReadOptions how;
        for (std::size_t n = 2; n < arguments.size(); n += 2) {
            RAMUS_TRY(said, with(how, arguments[n].substr(2), arguments[n + 1]));
            how = std::move(said);
        }
        return context.files->open_as_tree(arguments[0], how);
    }
    return context.files->open(arguments[0]);
}

Result<void> save(ActionContext& context, Arguments arguments) {
    if (!has_scene(context.document)) return fail("there is nothing to save a session of");
    const bool asks = context.files != nullptr && context.files->asks();
    if (arguments.empty() && asks && context.document.file().empty()) {
        context.files->ask_for_file(FilePurpose::kSave);
        return {};
    }
    const auto path = file_argument(context, arguments, "save", ".ramus.json");
    if (!path) return tl::unexpected(path.error());
    if (auto written = write_session(context.document.session(), *path); !written) return written;
    const std::filesystem::path full = std::filesystem::absolute(*path).lexically_normal();
    context.document.mark_saved(full);
    context.say("Session saved: " + full.string());
    return {};
}

Result<void> save_as(ActionContext& context, Arguments) {
    return ask_for_file(context, FilePurpose::kSave, fail("save-as needs a window", {}, "save FILE"));
}

Result<Outcome> shot(ActionContext& context, Arguments arguments) {
    if (arguments.empty() && context.files != nullptr && context.files->asks()) {
        context.files->ask_for_export("picture");
        return Done{};
    }
    RAMUS_TRY(path, file_argument(context, arguments, "shot", ".png"));
    const std::filesystem::path full = std::filesystem::absolute(path).lexically_normal();
    const Continuation say = [full](ActionContext& then) -> Result<void> {
        then.say("Picture saved: " + full.string());
        return {};
    };
    if (const auto coming = context.picture.deferred_picture())
        return Pending{"Drawing " + full.filename().string(),
                       [take = coming->take, full, say](Job& job) -> Result<Continuation> {
                           RAMUS_TRY(image, take());
                           if (job.cancelled()) return fail("cancelled");
                           if (auto written = render::write_png(image, full); !written)
                               return tl::unexpected(written.error());
                           return say;
                       },
                       true};
    if (auto written = context.picture.write_picture(path); !written) return tl::unexpected(written.error());
    return outcome_of(say(context));
}

Result<void> open_folder(ActionContext& context, Arguments) {
    if (context.window == nullptr) return no_window("desktop");
    const std::filesystem::path file = context.window->written();
    if (file.empty()) return fail("nothing was written yet");
    constexpr const char* kOpener = "xdg-open";
    if (find_program(kOpener).empty())
        return fail("xdg-open is not installed; it opens folders", file.parent_path().string(),
                    "apt install xdg-utils");
    return start_and_leave({kOpener, file.parent_path().string()});
}

// The number of an entry in the dialog, 1 and more; 0 for none.
Result<int> number_of_entry(Arguments arguments, const std::string& command) {
    if (arguments.empty()) return 0;
    const auto wanted = arguments.size() == 1 ? number_in(arguments[0], 1.0, 1e6) : std::nullopt;
    if (!wanted || *wanted != static_cast<int>(*wanted)) return fail(command + " takes the number of an entry");
    return static_cast<int>(*wanted);
}

Result<void> recover(ActionContext& context, Arguments arguments) {
    RAMUS_TRY(which, number_of_entry(arguments, "recover"));
    return context.files != nullptr ? context.files->recover(which) : fail("recover needs a window");
}

Result<void> discard_recovery(ActionContext& context, Arguments arguments) {
    RAMUS_TRY(which, number_of_entry(arguments, "discard-recovery"));
    if (which == 0) return fail("discard-recovery takes the number of an entry");
    if (io::keeps_existing_files())
        return fail("a commands file throws nothing away", {}, "give --overwrite if the commands are your own");
    return context.files != nullptr ? context.files->discard_recovery(which) : fail("discard-recovery needs a window");
}

Result<void> ui_scale(ActionContext& context, Arguments arguments) {
    constexpr double kStep = 1.125;
    const auto refused = fail("ui-scale takes a factor from 0.5 to 4, larger, smaller or auto");
    if (arguments.size() != 1) return refused;
    const std::string& word = arguments[0];
    const double now = context.window != nullptr ? context.window->ui_scale() : 1.0;
    const auto factor = word == "auto"      ? std::optional(0.0)
                        : word == "larger"  ? std::min(now * kStep, kMostUiScale)
                        : word == "smaller" ? std::max(now / kStep, kLeastUiScale)
                                            : number_in(word, kLeastUiScale, kMostUiScale);
    if (!factor) return refused;
    if (context.window == nullptr) return fail("ui-scale needs a window");
    context.window->set_ui_scale(*factor);
    return {};
}

Result<void> theme(ActionContext& context, Arguments arguments) {
    if (context.window == nullptr) return fail("there is no theme without a window");
    const bool toggles = arguments.empty();
    if (!toggles && (arguments.size() != 1 || (arguments[0] != "light" && arguments[0] != "dark")))
        return fail("theme takes light or dark");
    context.window->set_light_theme(toggles ? !context.window->light_theme() : arguments[0] == "light");
    return {};
}

bool theme_is_light(const ActionContext& context, const Command& command) {
    return !command.scripted() && context.window != nullptr && context.window->light_theme();
}

// Windows have no transparent background.
std::span<const GroundRow> grounds_of_windows() { return std::span(kGrounds).first(3); }

Result<void> background(ActionContext& context, Arguments arguments) {
    if (context.window == nullptr) return fail("background needs a window", {}, "pictures in files take --background");
    const auto grounds = grounds_of_windows();
    const auto row = arguments.size() == 1 ? std::ranges::find(grounds, arguments[0], &GroundRow::key) : grounds.end();
    if (row == grounds.end()) return fail("background takes dark, grey or white");
    context.window->set_ground(row->ground);
    return {};
}

Command background_entry(const GroundRow& row) {
    return Command("background", "dark|grey|white", "Puts this background behind the tree in the window.", background)
        .in_menu("View", row.label)
        .in_submenu("Background")
        .giving({std::string(row.key)})
        .in_use_when([&row](const ActionContext& context, const Command&) {
            return context.window != nullptr && context.window->ground() == row.ground;
        });
}

Result<void> quit(ActionContext& context, Arguments) {
    if (context.files == nullptr) return fail("quit needs a window");
    context.files->quit();
    return {};
}

Result<void> panel(ActionContext& context, Arguments arguments) {
    if (arguments.size() > 1 || (arguments.size() == 1 && arguments[0] != "explore" && arguments[0] != "surface" &&
                                 arguments[0] != "slices" && arguments[0] != "plan" && arguments[0] != "other"))
        return fail("panel shows or hides itself, or one of its pages", {},
                    "panel, panel explore, panel surface, panel slices or panel plan");
    return toggle_part(context, arguments.empty() ? "panel" : arguments[0]);
}

Result<void> warnings(ActionContext& context, Arguments arguments) {
    if (arguments.empty()) return toggle_part(context, "warnings");
    if (arguments.size() > 1 || arguments[0] != "read") return fail("warnings shows its list, or takes read");
    if (context.window == nullptr) return no_window("list of warnings");
    context.window->read_warnings();
    return {};
}

Result<void> branches(ActionContext& context, Arguments) { return toggle_part(context, "branches"); }
Result<void> help(ActionContext& context, Arguments) { return toggle_part(context, "help"); }
Result<void> menu(ActionContext& context, Arguments) { return toggle_part(context, "menu"); }
Result<void> palette(ActionContext& context, Arguments) { return toggle_part(context, "palette"); }

} // namespace

std::vector<Command> file_commands() {
    return {
        Command(
            "open", "[FILE [--tree [--labels LIST] [--isovalue X] [--radius MM] [--channel N] [--time N]]]",
            "Opens a tree, a session, a mask or a scan; without FILE, asks for one. A window asks what becomes of a "
            "mask or a scan, unless it is said.",
            open)
            .in_menu("File", "Open...", {"Ctrl+O"}),
        Command(
            "save", "[FILE]",
            "Writes the session: what is selected, hidden and highlighted, the camera, the options. Asks where, the "
            "first time.",
            save)
            .in_menu("File", "Save session", {"Ctrl+S"})
            .when(has_scene),
        Command("save-as", "", "Asks where to write the session.", save_as)
            .in_menu("File", "Save session as...", {"Ctrl+Shift+S"})
            .when(has_scene),
        Command("recover", "[N]",
                "Offers the sessions kept from runs that did not close properly, or recovers the N-th.", recover)
            .in_menu("File", "Recover..."),
        Command("discard-recovery", "N", "Discards the N-th session kept from a run that did not close properly.",
                discard_recovery),
        Command("shot", "[FILE]", "Writes the picture as PNG; without FILE, asks where, how large and on what ground.",
                shot)
            .in_menu("File", "Save picture...", {"F12"})
            .when(has_scene),
        export_command(),
        Command("open-folder", "", "Shows the folder of the file that was written last in the desktop's file manager.",
                open_folder),
        Command("quit", "", "Closes ramus.", quit).in_menu("File", "Quit", {"Ctrl+Q"}),
    };
}

std::vector<Command> window_commands() {
    std::vector<Command> commands{
        Command("panel", "[explore|surface|plan]",
                "Shows or hides the side panel, or shows a page of it: the tree and the selection, how the surface is "
                "made and shown, or the plan.",
                panel)
            .in_menu("View", "Side panel", {"Tab"})
            .in_submenu("Panels"),
        Command("panel", "[explore|surface|plan]",
                "Goes from the exploring page of the side panel to the planning page, and back.", panel)
            .in_menu("View", "Explore or plan", {"B"})
            .in_submenu("Panels")
            .giving({"other"})
            .when(has_tree),
        Command(
            "branches", "",
            "Shows the table of branches in a window of its own, which can be moved and made larger, or in the side "
            "panel again.",
            branches)
            .in_menu("View", "Branches in a window")
            .in_submenu("Panels")
            .when(has_tree)
            .in_use_when(shows_part("branches")),
        Command("warnings", "[read]",
                "Shows or hides what a person should know: what was assumed and repaired, files that were not written; "
                "read takes all out of the count.",
                warnings)
            .in_menu("View", "Warnings")
            .in_submenu("Panels")
            .in_use_when(shows_part("warnings")),
        Command("ui-scale", "FACTOR|larger|smaller|auto",
                "Sets how large text and panels are, in pixels per point; auto is what the display says.", ui_scale),
        Command("ui-scale", "FACTOR|larger|smaller|auto", "Makes text and panels larger.", ui_scale)
            .in_menu("View", "Larger interface")
            .in_submenu("Interface")
            .giving({"larger"}),
        Command("ui-scale", "FACTOR|larger|smaller|auto", "Makes text and panels smaller.", ui_scale)
            .in_menu("View", "Smaller interface")
            .in_submenu("Interface")
            .giving({"smaller"}),
        Command("theme", "[light|dark]",
                "Switches between light and dark panels; the picture stays as it is, and the next start knows it.",
                theme)
            .in_menu("View", "Light theme")
            .in_submenu("Interface")
            .in_use_when(theme_is_light),
        Command("help", "", "Shows what the mouse and the keys do.", help)
            .in_menu("Help", "Mouse and keys", {"F1", "?"}),
        Command("menu", "", "Opens the menus; arrows, Enter and Escape lead through them.", menu).on_keys({"F10"}),
        Command("palette", "", "Finds commands by words: type what you want to do.", palette)
            .in_menu("Help", "Find a command...", {"Ctrl+K", "Ctrl+P"}),
        Command("background", "dark|grey|white", "Puts a dark, grey or white background behind the tree in the window.",
                background),
    };
    for (const GroundRow& row : grounds_of_windows()) commands.push_back(background_entry(row));
    return commands;
}

} // namespace ramus::app::actions
