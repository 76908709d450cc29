// The left part of the dialogs for files: where a person may want to go.
#pragma once

#include <filesystem>
#include <span>

namespace ramus::app {

// A few folders and the recent files, in a column of this width in pixels. Returns the path that was chosen; empty:
// none.
[[nodiscard]] std::filesystem::path draw_places(float width, std::span<const std::filesystem::path> recent_files);

} // namespace ramus::app
