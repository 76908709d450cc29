// What a process may still do that reads a file with somebody else's library: compute, take memory, and answer.
#pragma once

#include <sys/types.h>

namespace ramus {

// From here on this process ends with `parent`, has no descriptor but this one and the standard ones, can win no
// rights, and, where the kernel has seccomp, is refused (EPERM) all that is not computing: it opens and makes no files,
// has no network, starts no program, process or thread, and touches no other process. Memory that can be written cannot
// be run. To be called in a process that has one thread.
//
// A kernel without seccomp leaves the last part out; the limits of ProcessLimits hold there, too.
void confine_this_process(int descriptor, pid_t parent);

} // namespace ramus
