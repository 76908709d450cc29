// Runs a command that draws for long with `ramus render` in a separate process, which gets the current session. The
// window stays responsive, cancelling ends the process, and a failing graphics card affects only that process. Cost:
// the process makes the surface again.
#pragma once

#include "app/session/session.h"
#include "core/base/error.h"
#include "core/base/job.h"

#include <functional>
#include <string>
#include <vector>

namespace ramus::app {

// Returns the work, for any thread. `words`: a command, its name first. `software`: use OpenGL on the processor, as the
// window does; false: a graphics card. Fails if the session cannot be written.
[[nodiscard]] Result<std::function<Result<void>(Job&)>>
render_process_work(const Session& session, const std::vector<std::string>& words, bool software);

} // namespace ramus::app
