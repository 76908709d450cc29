// Options of `ramus render` for papers and slides (app/picture/figure_options.h).
#pragma once

#include "app/picture/figure_options.h"

#include <CLI/CLI.hpp>

namespace ramus::app {

void add_figure_flags(CLI::App& command, FigureOptions& flags);

} // namespace ramus::app
