// Both ends of a process of its own: the work, and whoever waits for its answer.
#pragma once

#include "core/base/own_process.h"

#include <sys/types.h>

namespace ramus {

// In the process that is there for it, a child of `parent`: does the work, answers on this descriptor, and ends.
[[noreturn]] void work_and_end(OwnWork work, std::string_view input, const ProcessLimits& limits, int answer,
                               pid_t parent);

// In the other one. Fails where the answer has no end, or is longer than the limit.
[[nodiscard]] Result<std::string> read_answer(int descriptor, const ProcessLimits& limits);

} // namespace ramus
