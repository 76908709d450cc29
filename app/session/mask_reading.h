// Options for turning a segmentation mask into a tree, as text: on the command line, in commands, in sessions.
#pragma once

#include "core/base/error.h"
#include "core/io/trees/imported_tree.h"

#include <glm/vec3.hpp>
#include <string>
#include <string_view>

namespace ramus::app {

[[nodiscard]] bool is_mask_option(std::string_view key);

// Returns `mask` with one option changed. Keys: labels (apart, together, or those of each system: 1+3,2), fill-holes
// (on, off), bulge-size, islands (mm), root (X,Y,Z in mm, RAS); "auto" resets the option. Errors say what the key
// takes.
[[nodiscard]] Result<io::MaskReading> with(io::MaskReading mask, std::string_view key, const std::string& value);

// Merges options: those specified in `said` override the session's.
[[nodiscard]] io::MaskReading over(const io::MaskReading& said, io::MaskReading session);

// "together", "1+3,portal vein": as with() reads them.
[[nodiscard]] std::string spelled(const std::vector<std::vector<volume::LabelChoice>>& labels);
[[nodiscard]] std::string exact_place(const glm::dvec3& place); // "1.5,-20,3": as with() reads it

} // namespace ramus::app
