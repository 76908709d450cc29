// `ramus info` of a mask or scan.
#pragma once

#include "app/commands/surface_flags.h"
#include "core/base/error.h"

#include <string>

namespace ramus::app {

// Prints size, spacing, orientation, type and labels with their volumes; as one JSON object if `json`. Returns the exit
// status.
[[nodiscard]] Result<int> run_volume_info(const std::string& file, const SurfaceFlags& flags, bool json);

} // namespace ramus::app
