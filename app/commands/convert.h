// ramus convert FILE -o FILE: a vessel tree in another format.
#pragma once

#include "app/commands/command.h"

namespace ramus::app {

void register_convert(CLI::App& app, Action& chosen);

} // namespace ramus::app
