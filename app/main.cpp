// The command line: one CLI::App, one file of app/commands for each subcommand, and the window without one.
#include "app/commands/command.h"
#include "app/commands/convert.h"
#include "app/commands/grow.h"
#include "app/commands/info.h"
#include "app/commands/interrupt.h"
#include "app/commands/mesh.h"
#include "app/commands/render.h"
#include "app/commands/surface_flags.h"
#include "app/window/run_window.h"

#include <csignal>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <iostream>

namespace ramus::app {

namespace {

int complain(const std::string& message) {
    std::cerr << "ramus: " << message << '\n';
    return kFailed;
}

// A word that is no file and looks like none was meant as a command.
bool meant_as_command(const std::string& word) {
    std::error_code ignored;
    return word.find_first_of("./") == std::string::npos && !std::filesystem::exists(word, ignored);
}

int run(int argc, char** argv) {
    CLI::App app(
        "Vessel trees as smooth, closed, faithful surfaces: to explore in a window and to picture without one.",
        "ramus");
    app.set_version_flag("--version", "ramus " RAMUS_VERSION);
    app.require_subcommand(0, 1);

    Action chosen;
    std::vector<std::string> files;
    SurfaceFlags window_flags;
    app.add_option("FILE", files, "Vessel trees to open in the window; without one, the demo tree")->type_name("");
    add_surface_flags(app, window_flags);
    register_grow(app, chosen);

    register_render(app, chosen);
    register_mesh(app, chosen);
    register_info(app, chosen);
    register_convert(app, chosen);

    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? kDone : kWrongUsage;
    }
    if (!chosen) {
        if (!files.empty() && meant_as_command(files.front())) {
            complain(files.front() + ": neither a command nor a file; ramus --help lists the commands");
            return kWrongUsage;
        }
        return run_window(files, window_flags.surface);
    }

    handle_interrupts(); // not before: the window closes in its own way
    const Result<int> status = chosen();
    if (!status) return complain(status.error().message());
    // A full disk behind a redirection shows here at the latest.
    if (!std::cout.flush() || std::fflush(stdout) != 0) return complain("standard output cannot be written");
    return *status;
}

} // namespace

} // namespace ramus::app

int main(int argc, char** argv) {
    // Writing beyond `ulimit -f` shall be an error that a command reports, not a signal that kills it.
    std::signal(SIGXFSZ, SIG_IGN);
    try {
        return ramus::app::run(argc, argv);
    } catch (const std::bad_alloc&) {
        return ramus::app::complain("not enough memory; a coarser --detail or --cell needs less");
    } catch (const std::exception& error) {
        return ramus::app::complain(error.what());
    }
}
