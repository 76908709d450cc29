// The files opened last, newest first, kept in $XDG_STATE_HOME/ramus/recent (~/.local/state without it). Nothing fails
// when that cannot be read or written: the list is a convenience.
#pragma once

#include <filesystem>
#include <vector>

namespace ramus::app {

inline constexpr std::size_t kRecentFiles = 10;

// Of this process: read from the disk at the first call. Files that are gone are left out.
[[nodiscard]] const std::vector<std::filesystem::path>& recent_files();
void remember_file(const std::filesystem::path& path);

} // namespace ramus::app
