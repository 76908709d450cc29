// How every command reads its mask or scan: with a progress bar, and an interrupt cancels.
#pragma once

#include "app/commands/surface_flags.h"
#include "core/base/error.h"
#include "core/volume/volume.h"

#include <string>

namespace ramus::app {

// What was assumed where the file does not say is told on standard error with --verbose.
[[nodiscard]] Result<volume::Volume> load_volume(const std::string& file, const SurfaceFlags& flags);

} // namespace ramus::app
