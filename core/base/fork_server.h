// A small process that forks in place of a large one.
#pragma once

#include "core/base/own_process.h"

#include <optional>

namespace ramus {

// None: there is no such process, or it has ended.
[[nodiscard]] std::optional<Result<std::string>> run_at_fork_server(OwnWork work, std::string_view input,
                                                                    const ProcessLimits& limits);

} // namespace ramus
