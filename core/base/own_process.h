// Runs a function in a process of its own, for libraries that damaged input makes crash or hang: what happens there
// cannot hurt this program. It hands back bytes; nothing else of what it does is seen. The process computes and
// answers, and can do nothing else (core/base/confinement.h); it ends with this one.
#pragma once

#include "core/base/error.h"

#include <cstdint>
#include <string>
#include <string_view>

namespace ramus {

struct ProcessLimits {
    std::uint64_t memory = std::uint64_t{1} << 30; // bytes, beyond what the process begins with
    unsigned seconds = 60;                         // of processor time
    std::uint64_t answer = std::uint64_t{1} << 31; // bytes
};

// Bytes in, bytes out. It must use nothing that another thread may hold locked, but for memory, and no variable that
// changes.
using OwnWork = std::string (*)(std::string_view input);

// The bytes that `work` returns. Fails where it crashes or exceeds a limit.
[[nodiscard]] Result<std::string> run_in_own_process(OwnWork work, std::string_view input, const ProcessLimits& limits);

// From here on such processes are forks of a small process that this starts, which ends when this one does. Forks of
// this one copy the tables of all its pages, and each thread that needs a page waits meanwhile: 0.15 s beside a large
// surface. To be called once, while there is little memory and no other thread. Where it cannot be started, this one
// goes on being forked.
void fork_small_processes();

} // namespace ramus
