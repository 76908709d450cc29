// What a process does about limits that it was started with (ulimit), where libraries do nothing.
#pragma once

#include <functional>

namespace ramus {

// What `work` returns. Where the process was given a small stack (`ulimit -s`), it runs in a thread with one of usual
// size, and threads that are made later get such stacks, too. Fails with a word on standard error and status 1 where
// there is no memory for it.
[[nodiscard]] int with_usual_stacks(const std::function<int()>& work);

// Where memory is limited (`ulimit -v`), a crash is most likely that of a library that got none, as Mesa's: from here
// on it is a word on standard error and status 1. Without a limit a crash stays what it is, for those who look for
// defects.
void explain_want_of_memory();

} // namespace ramus
