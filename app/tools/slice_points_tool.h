// The tool that puts the oblique slice through three places: on vessels, on slices among them, or on slices next to
// them.
#pragma once

#include "app/tools/tool.h"

#include <memory>

namespace ramus::app {

[[nodiscard]] std::unique_ptr<Tool> make_slice_points_tool();

} // namespace ramus::app
