// What kind of file it is that someone wants to open, and where the demo tree is that ships with ramus.
#pragma once

#include <filesystem>
#include <optional>

namespace ramus::app {

// Whether the file says that it is a session, not a tree. False when it cannot be read: reading it then says why.
[[nodiscard]] bool is_session_file(const std::filesystem::path& path);

// The demo tree: in $RAMUS_ASSETS, beside the program's installation, or in the sources it was built from.
[[nodiscard]] std::optional<std::filesystem::path> demo_tree();

} // namespace ramus::app
