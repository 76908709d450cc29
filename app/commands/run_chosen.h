// Runs the command that a command line has chosen, for the main functions of the programs.
#pragma once

#include "app/commands/command.h"

#include <string>

namespace ramus::app {

// Prints an error; returns the exit status of a failure.
int complain(const std::string& message);

// Runs the action and returns its exit status. Interrupts cancel it from now on.
[[nodiscard]] int run_chosen(const Action& chosen);

} // namespace ramus::app
