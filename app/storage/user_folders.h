// Folders for ramus's own data and for saved files, by the XDG rules. Each may be empty, since a user may have no home
// folder. Only make_private() creates anything.
#pragma once

#include <filesystem>
#include <string_view>
#include <system_error>

namespace ramus::app {

class Document;

namespace user_folders {

[[nodiscard]] std::filesystem::path home();     // $HOME, else from the user database
[[nodiscard]] std::filesystem::path settings(); // $XDG_CONFIG_HOME/ramus, else ~/.config/ramus
[[nodiscard]] std::filesystem::path state();    // $XDG_STATE_HOME/ramus, else ~/.local/state/ramus

// The user's folders from user-dirs.dirs; empty if they do not exist.
[[nodiscard]] std::filesystem::path pictures();
[[nodiscard]] std::filesystem::path documents();

// Creates the folder if necessary, accessible only to the user. For folders that only ramus writes to.
[[nodiscard]] std::error_code make_private(const std::filesystem::path& folder);

[[nodiscard]] bool writable(const std::filesystem::path& folder); // exists, and files can be created there

} // namespace user_folders

// The file to save to if the user gave no name. Absolute.
//
// A session (".ramus.json"): the session file last read or saved; otherwise next to the tree, or if that is not
// writable in the documents or home folder, under a new name. Everything else (".png", ".csv"): next to the session
// file; otherwise pictures in the pictures folder and the rest next to the tree; never an existing file.
[[nodiscard]] std::filesystem::path suggested_file(const Document& document, std::string_view extension);

} // namespace ramus::app
