// The command line: one CLI::App with a file of app/commands per subcommand; without a subcommand the window.
#include "app/commands/command.h"
#include "app/commands/picture_flags.h"
#include "app/commands/run_chosen.h"
#include "app/commands/subcommands.h"
#include "app/commands/suggestions.h"
#include "app/commands/surface_flags.h"
#include "app/window/run_window.h"
#include "core/base/instruction_sets.h"
#include "core/base/resource_limits.h"

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <string>
#include <vector>

namespace ramus::app {

namespace {

void add_window_flags(CLI::App& app, WindowOptions& window) {
    const char* group = "Window";
    app.add_option("--session", window.session, "Open this session")->type_name("FILE")->group(group);
    app.add_option("--commands", window.commands, "Run these commands as soon as the surface is ready")
        ->type_name("FILE")
        ->group(group);
    app.add_flag("--overwrite", window.overwrite, kOverwriteHelp)->needs("--commands")->group(group);
    add_option(app, "--ui-scale", "FACTOR", window.scale, "Pixels per point; without it, what the display says")
        ->check(CLI::Range(0.5, 4.0))
        ->group(group);
    app.add_option_function<std::string>(
           "--size",
           [&window](const std::string& text) {
               char end = '\0';
               if (std::sscanf(text.c_str(), "%dx%d%c", &window.size.x, &window.size.y, &end) != 2 ||
                   window.size.x < 480 || window.size.y < 360 || window.size.x > 16384 || window.size.y > 16384)
                   throw CLI::ValidationError("--size", text + " is not a size like 1440x900 (from 480x360)");
           },
           "Size of the window, in points; without it, as it was the last time")
        ->type_name("WxH")
        ->group(group);
    add_graphics_memory_flag(app, window.graphics_bytes)->group(group);
    app.add_option("--status", window.status,
                   "Keep a JSON file that says what the window shows, for scripts that drive it")
        ->type_name("FILE")
        ->group(group);
}

// A word that is no file and looks like none was meant as a command.
bool meant_as_command(const std::string& word) {
    std::error_code ignored;
    return !word.empty() && word.find_first_of("./") == std::string::npos && !std::filesystem::exists(word, ignored);
}

int run(int argc, char** argv) {
    if (const char* wanted = std::getenv(kInstructionsVariable); wanted != nullptr)
        if (const auto limited = limit_instructions(wanted); !limited) return complain(limited.error().message());
    CLI::App app(
        "Vessel trees as smooth, closed, faithful surfaces: to explore in a window and to picture without one.",
        "ramus");
    app.set_version_flag("--version", "ramus " RAMUS_VERSION);
    app.require_subcommand(0, 1);
    app.failure_message(failure_text);

    Action chosen;
    WindowOptions window;
    SurfaceFlags window_flags;
    app.add_option("FILE", window.files,
                   "Vessel tree, mask, scan, mesh or session to open in the window; without one, the demo tree")
        ->type_name("");
    add_surface_flags(app, window_flags);
    add_window_flags(app, window);

    for (const auto& subcommand : kSubcommands) subcommand(app, chosen);

    // Checked before parsing the options that follow, which belong to that command.
    const std::string first = argc > 1 ? argv[1] : "";
    if (!first.starts_with("-") && !is_command(app, first) && meant_as_command(first)) {
        complain(unknown_command(app, first));
        return kWrongUsage;
    }
    try {
        app.parse(argc, argv);
    } catch (const CLI::ExtrasError& error) {
        // After options of the window the command is not the first word. A word after an unknown option belongs to that
        // option.
        const std::vector<std::string> words(argv, argv + argc);
        const auto place_of = [&](const std::string& word) { return std::ranges::find(words, word); };
        const bool is_first = !window.files.empty() && !app.remaining().empty() &&
                              place_of(window.files.front()) < place_of(app.remaining().front());
        if (is_first && meant_as_command(window.files.front()))
            complain(unknown_command(app, window.files.front()));
        else
            app.exit(error);
        return kWrongUsage;
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? kDone : kWrongUsage;
    }
    if (!chosen) {
        if (std::ranges::find(window.files, "-") != window.files.end()) {
            complain("the window opens files, not standard input; ramus render and the other commands take -");
            return kWrongUsage;
        }
        if (!window.files.empty() && meant_as_command(window.files.front())) {
            complain(unknown_command(app, window.files.front()));
            return kWrongUsage;
        }
        window.surface = window_flags.surface;
        window.read = window_flags.read;
        return run_window(window);
    }

    return run_chosen(chosen);
}

} // namespace

} // namespace ramus::app

int main(int argc, char** argv) {
    // Writing beyond `ulimit -f` is an error that a command reports, not a signal that kills it.
    std::signal(SIGXFSZ, SIG_IGN);
    ramus::explain_out_of_memory();
    return ramus::run_with_usual_stacks([=] {
        return ramus::app::run_caught([=] { return ramus::app::run(argc, argv); },
                                      "a coarser --detail or --cell needs less");
    });
}
