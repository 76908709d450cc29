// ramus grow: a synthetic organ tree, written as a tree file.
#pragma once

#include "app/commands/command.h"

namespace ramus::app {

void register_grow(CLI::App& app, Action& chosen);

} // namespace ramus::app
