// The two ends of a separate process (own_process.h): the side that works, and the side that reads its answer.
#pragma once

#include "core/base/own_process.h"

#include <sys/types.h>

namespace ramus {

// Called in the child of `parent`: confines the process, runs `work`, writes the answer to `answer`, and ends.
[[noreturn]] void work_and_end(OwnWork work, std::string_view input, const ProcessLimits& limits, int answer,
                               pid_t parent);

// Called in the parent: reads the answer. Fails if the answer is incomplete or longer than the limit.
[[nodiscard]] Result<std::string> read_answer(int descriptor, const ProcessLimits& limits);

} // namespace ramus
