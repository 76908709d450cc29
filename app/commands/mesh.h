// ramus mesh FILE -o MESH: the surface of a vessel tree as a file.
#pragma once

#include "app/commands/command.h"

namespace ramus::app {

void register_mesh(CLI::App& app, Action& chosen);

} // namespace ramus::app
