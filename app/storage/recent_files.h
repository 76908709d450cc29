// The files opened last, newest first, kept in the state folder (app/storage/places.h). Nothing fails when that cannot
// be read or written: the list is a convenience.
#pragma once

#include <filesystem>
#include <vector>

namespace ramus::app {

// Of this process: read from the disk at the first call. Files that are gone are left out.
[[nodiscard]] const std::vector<std::filesystem::path>& recent_files();
// At most so many are kept, none for 0.
void remember_file(const std::filesystem::path& path, std::size_t most);

} // namespace ramus::app
