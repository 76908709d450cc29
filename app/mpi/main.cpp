// `mpirun -n N ramus-mpi mesh TREE -o MESH`: one surface, made by all processes of an MPI job.
#include "app/commands/harmless_output.h"
#include "app/commands/run_chosen.h"
#include "app/commands/subcommands.h"
#include "app/mpi/mpi_team.h"
#include "core/base/resource_limits.h"

#include <csignal>
#include <exception>
#include <iostream>
#include <new>

namespace ramus::app {

namespace {

int run(int argc, char** argv, Team& team) {
    CLI::App app("ramus for MPI: one surface, larger than a machine holds, made by many processes.", "ramus-mpi");
    app.set_version_flag("--version", "ramus " RAMUS_VERSION);
    app.require_subcommand(1);
    Action chosen;
    register_mesh_together(app, chosen, team);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        // All processes read the same command line, and one of them answers.
        if (!team.leads()) return error.get_exit_code() == 0 ? kDone : kWrongUsage;
        return app.exit(error) == 0 ? kDone : kWrongUsage;
    }
    return run_chosen(chosen);
}

int run_caught(int argc, char** argv, Team& team) {
    const HarmlessOutput harmless;
    try {
        return run(argc, argv, team);
    } catch (const std::bad_alloc&) {
        return complain("not enough memory; a coarser --detail or --cell, or more processes, need less");
    } catch (const std::exception& error) {
        return complain(error.what());
    }
}

} // namespace

} // namespace ramus::app

int main(int argc, char** argv) {
    std::signal(SIGXFSZ, SIG_IGN); // as ramus
    ramus::explain_out_of_memory();
    ramus::app::MpiTeam team(argc, argv);
    const int status = ramus::run_with_usual_stacks([&] { return ramus::app::run_caught(argc, argv, team); });
    // The others wait for a process that fails.
    if (status == ramus::app::kFailed) team.abort(status);
    team.finish();
    return status;
}
