// `mpirun -n N ramus-mpi mesh TREE -o MESH`: one surface, made by all processes of an MPI job.
#include "app/commands/run_chosen.h"
#include "app/commands/subcommands.h"
#include "app/mpi/mpi_team.h"
#include "core/base/resource_limits.h"

#include <chrono>
#include <csignal>
#include <iostream>
#include <sstream>
#include <thread>

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

} // namespace

} // namespace ramus::app

int main(int argc, char** argv) {
    std::signal(SIGXFSZ, SIG_IGN); // as ramus
    ramus::explain_out_of_memory();
    ramus::app::MpiTeam team(argc, argv);
    std::ostringstream held;
    std::streambuf* const usual = std::cerr.rdbuf();
    if (!team.leads()) std::cerr.rdbuf(held.rdbuf());
    const int status = ramus::run_with_usual_stacks([&] {
        return ramus::app::run_caught([&] { return ramus::app::run(argc, argv, team); },
                                      "a coarser --detail or --cell, or more processes, need less");
    });
    std::cerr.rdbuf(usual);
    if (status == ramus::app::kFailed) {
        // What fails for all is said once: the leader ends the job before another process speaks.
        if (!team.leads()) std::this_thread::sleep_for(std::chrono::seconds(1));
        std::cerr << held.str() << std::flush;
        team.abort(status); // the others wait for this one
    }
    team.finish();
    return status;
}
