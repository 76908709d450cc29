// The subcommands of `ramus`, in the order of `ramus --help`. To add one, add a file to app/commands and its register
// function to both lists. A register function adds the subcommand to `app`; parsing the subcommand sets `chosen`.
#pragma once

#include "app/commands/command.h"
#include "core/base/team.h"

#include <array>

namespace ramus::app {

void register_grow(CLI::App& app, Action& chosen);
void register_render(CLI::App& app, Action& chosen);
void register_study(CLI::App& app, Action& chosen);
void register_ratings(CLI::App& app, Action& chosen);
void register_paper(CLI::App& app, Action& chosen);
void register_compare(CLI::App& app, Action& chosen);
void register_validate(CLI::App& app, Action& chosen);
void register_mesh(CLI::App& app, Action& chosen);
void register_info(CLI::App& app, Action& chosen);
void register_convert(CLI::App& app, Action& chosen);
void register_skeletonize(CLI::App& app, Action& chosen);
void register_territories(CLI::App& app, Action& chosen);
void register_resect(CLI::App& app, Action& chosen);
void register_region(CLI::App& app, Action& chosen);
void register_slice(CLI::App& app, Action& chosen);
void register_reformat(CLI::App& app, Action& chosen);
void register_report(CLI::App& app, Action& chosen);
void register_page(CLI::App& app, Action& chosen);
void register_cohort(CLI::App& app, Action& chosen);

// `mesh` for the processes of a team, which make one surface. It must outlive `chosen`.
void register_mesh_together(CLI::App& app, Action& chosen, Team& team);

inline constexpr std::array kSubcommands{register_grow,   register_render,  register_study,       register_ratings,
                                         register_paper,  register_compare, register_validate,    register_mesh,
                                         register_info,   register_convert, register_skeletonize, register_territories,
                                         register_resect, register_region,  register_slice,       register_reformat,
                                         register_report, register_page,    register_cohort};

} // namespace ramus::app
