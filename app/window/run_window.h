// The window: opens `files` (the demo tree when there are none) and stays until the person closes it. Returns the exit
// status. Without a display it says so and points at `ramus render`.
#pragma once

#include "core/mesh/surface.h"

#include <string>
#include <vector>

namespace ramus::app {

int run_window(const std::vector<std::string>& files, const mesh::SurfaceOptions& options);

} // namespace ramus::app
