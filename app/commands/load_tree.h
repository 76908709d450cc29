// How every command reads its tree: what was repaired is told on standard error, and with --verbose what was found.
#pragma once

#include "app/commands/surface_flags.h"
#include "core/base/error.h"
#include "core/tree/vessel_tree.h"

#include <string>

namespace ramus::app {

[[nodiscard]] Result<tree::VesselTree> load_tree(const std::string& file, const SurfaceFlags& flags);

// A line on standard error, with --verbose only.
void say(const SurfaceFlags& flags, const std::string& line);

} // namespace ramus::app
