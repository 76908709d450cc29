// The left part of file dialogs: common folders and recent files.
#pragma once

#include <filesystem>
#include <span>

namespace ramus::app {

// `width`: of the column in pixels. Returns the chosen path; empty: none.
[[nodiscard]] std::filesystem::path draw_places(float width, std::span<const std::filesystem::path> recent_files);

} // namespace ramus::app
