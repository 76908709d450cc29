// Work that draws for long, done by `ramus render` in a process of its own: it gets the session as it is now and one
// command. The window goes on, cancelling ends that process, and a graphics card that fails there fails there alone.
// The surface is made once more for it.
#pragma once

#include "app/session/session.h"
#include "core/base/error.h"
#include "core/base/job.h"

#include <functional>
#include <string>
#include <vector>

namespace ramus::app {

// `words`: a command's name first. Fails where the session cannot be told. `software`: OpenGL on the processor, as the
// window draws; else a graphics card's.
[[nodiscard]] Result<std::function<Result<void>(Job&)>>
work_elsewhere(const Session& session, const std::vector<std::string>& words, bool software);

} // namespace ramus::app
