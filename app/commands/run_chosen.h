// Runs the command that a command line has chosen, for the main functions of the programs.
#pragma once

#include "app/commands/command.h"

#include <functional>
#include <string>

namespace ramus::app {

// Prints an error; returns the exit status of a failure.
int complain(const std::string& message);

// Runs a program, with control characters escaped in what it prints. What it throws becomes an error; `needs_less`:
// what takes less memory.
[[nodiscard]] int run_caught(const std::function<int()>& program, const std::string& needs_less);

// Runs the action and returns its exit status. Interrupts cancel it from now on.
[[nodiscard]] int run_chosen(const Action& chosen);

} // namespace ramus::app
