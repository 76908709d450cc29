// What `ramus info` tells of a mask or a scan: size, spacing, orientation, type, and labels with their volumes.
#pragma once

#include "core/volume/volume.h"

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace ramus::app {

[[nodiscard]] nlohmann::ordered_json volume_json(const volume::Volume& volume);
// As text on standard output, under the name of its file.
void print_volume(const std::string& file, const volume::Volume& volume);

} // namespace ramus::app
