// The recently opened files, newest first, in the state folder (app/storage/user_folders.h). Errors are ignored: the
// list is a convenience.
#pragma once

#include <filesystem>
#include <vector>

namespace ramus::app {

// Omits files that no longer exist.
[[nodiscard]] std::vector<std::filesystem::path> read_recent_files();
// Moves the file to the front and keeps at most `most` files. Returns the new list.
[[nodiscard]] std::vector<std::filesystem::path> remember_file(const std::filesystem::path& path, std::size_t most);

} // namespace ramus::app
