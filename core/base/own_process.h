// Runs a function in a separate process, for libraries that crash or hang on damaged input. Bytes go in and bytes come
// out. The process is confined (core/base/confinement.h): it computes and answers, and can do nothing else. It ends
// when this process ends.
#pragma once

#include "core/base/error.h"

#include <cstdint>
#include <string>
#include <string_view>

namespace ramus {

struct ProcessLimits {
    std::uint64_t memory = std::uint64_t{1} << 30; // bytes of address space, beyond what the process begins with
    unsigned seconds = 60;                         // of processor time
    std::uint64_t answer = std::uint64_t{1} << 31; // bytes
};

// Runs after fork(), where other threads and their locks do not go on: it must take no lock except the allocator's, and
// read no variable that changes.
using OwnWork = std::string (*)(std::string_view input);

// Returns the bytes that `work` returns. Blocks the calling thread. Fails where `work` crashes or exceeds a limit, or
// no process can be started.
[[nodiscard]] Result<std::string> run_in_own_process(OwnWork work, std::string_view input, const ProcessLimits& limits);

// Starts a small process (core/base/fork_server.h) that from now on forks in place of this one; it ends when this
// process ends. A fork of a process with a large surface copies the page tables, and stops all of its threads for 0.15
// s. Call it once, early: while the process has little memory and one thread. Where it cannot be started, this process
// forks itself, as before.
void start_fork_server();

} // namespace ramus
