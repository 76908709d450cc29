// The options of `ramus render` for figures in papers and slides (app/picture/figure_options.h).
#pragma once

#include "app/picture/figure_options.h"

#include <CLI/CLI.hpp>

namespace ramus::app {

// Adds the options to `command`; parsing writes to `flags`, which must live as long as the command.
void add_figure_flags(CLI::App& command, FigureOptions& flags);

} // namespace ramus::app
