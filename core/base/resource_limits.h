// Handles resource limits that the process was started with (ulimit): small stacks, and little memory.
#pragma once

#include <functional>

namespace ramus {

// Runs `work` and returns its exit status. Where the process has a stack of less than 8 MiB (`ulimit -s`), `work` runs
// in a thread with 8 MiB, and threads that start later get 8 MiB too. Where that thread cannot start, prints a message
// on standard error and returns EXIT_FAILURE.
[[nodiscard]] int run_with_usual_stacks(const std::function<int()>& work);

// Where memory is limited (`ulimit -v`), a crash most likely comes from a library, such as Mesa, that did not get
// memory. From this call on a crash then prints a message on standard error and exits with EXIT_FAILURE. Without a
// limit crashes stay as they are, for debugging.
void explain_out_of_memory();

} // namespace ramus
