// The fork server: a small process that forks in place of this one. start_fork_server() (own_process.h) starts it.
#pragma once

#include "core/base/own_process.h"

#include <optional>

namespace ramus {

// run_in_own_process() by the fork server. None: the server was not started, or it has ended.
[[nodiscard]] std::optional<Result<std::string>> run_at_fork_server(OwnWork work, std::string_view input,
                                                                    const ProcessLimits& limits);

} // namespace ramus
