// Confines a process that reads a file with a third-party library: it may compute, allocate memory and answer.
#pragma once

#include <sys/types.h>

namespace ramus {

// Confines the calling process for good. It must have one thread, and `parent` as its parent. From then on
// - it is killed when `parent` ends,
// - it has no open descriptor except `descriptor` and the three standard ones,
// - it cannot gain privileges,
// - with seccomp, all system calls that are not for computing fail with EPERM: it cannot open or create files, use the
//   network, start a program, process or thread, affect another process, or map executable memory.
//
// Not guaranteed: the last point on a kernel without seccomp. The limits of ProcessLimits hold there too.
void confine_this_process(int descriptor, pid_t parent);

} // namespace ramus
