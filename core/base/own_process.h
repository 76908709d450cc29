// Runs a function in a process of its own, for libraries that damaged input makes crash or hang: what happens there
// cannot hurt this program. It gets a copy of all memory and hands back bytes; nothing else of what it does is seen.
#pragma once

#include "core/base/error.h"

#include <cstdint>
#include <functional>
#include <string>

namespace ramus {

struct ProcessLimits {
    std::uint64_t memory = std::uint64_t{1} << 30; // bytes, beyond what this process has now
    unsigned seconds = 60;                         // of processor time
    std::uint64_t answer = std::uint64_t{1} << 31; // bytes
};

// The bytes that `work` returns. Fails where it crashes or exceeds a limit. `work` must neither wait for other threads
// nor use what they may hold locked, but for memory.
[[nodiscard]] Result<std::string> run_in_own_process(const std::function<std::string()>& work,
                                                     const ProcessLimits& limits);

} // namespace ramus
