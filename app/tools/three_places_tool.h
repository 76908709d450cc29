// The tools that take three clicks, on vessels, on slices among them, or on slices next to them.
#pragma once

#include "app/tools/tool.h"

#include <memory>

namespace ramus::app {

[[nodiscard]] std::unique_ptr<Tool> make_slice_points_tool(); // the oblique slice through them
[[nodiscard]] std::unique_ptr<Tool> make_points_tool();       // a plane that divides the organ

} // namespace ramus::app
