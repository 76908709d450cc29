// `ramus render`: the window's picture without a window.
#pragma once

#include "app/commands/command.h"

namespace ramus::app {

void register_render(CLI::App& app, Action& chosen);

} // namespace ramus::app
