// Output of `ramus info` for a mask or a scan: size, spacing, orientation, type, and labels with their volumes.
#pragma once

#include "core/volume/volume.h"

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace ramus::app {

// Lengths are in mm, volumes in ml.
[[nodiscard]] nlohmann::ordered_json volume_json(const volume::Volume& volume);
// Prints the same as text on standard output, with `file` as the heading.
void print_volume(const std::string& file, const volume::Volume& volume);

} // namespace ramus::app
