// The tool that puts the oblique slice through three places: on vessels, on slices among them, or on slices next to
// them.
#pragma once

#include "app/tools/tool.h"

#include <memory>
#include <string_view>

namespace ramus::app {

// Its name among the tools. Slices pass it their clicks, as picks of a plane.
inline constexpr std::string_view kSlicePoints = "slice-points";

[[nodiscard]] std::unique_ptr<Tool> make_slice_points_tool();

} // namespace ramus::app
