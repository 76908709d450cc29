// The files opened last, newest first, kept in the state folder (app/storage/user_folders.h). Nothing fails when that
// cannot be read or written: the list is a convenience.
#pragma once

#include <filesystem>
#include <vector>

namespace ramus::app {

// Files that are gone are left out.
[[nodiscard]] std::vector<std::filesystem::path> read_recent_files();
// With this file first; at most so many are kept, none for 0. Returns the list as it is now.
[[nodiscard]] std::vector<std::filesystem::path> remember_file(const std::filesystem::path& path, std::size_t most);

} // namespace ramus::app
