// The folders where ramus keeps things between runs, and where what it saves goes, by the XDG rules. Every one
// may be empty: a machine without a home folder is legal, and then there is no such folder. Only make_private() creates
// anything.
#pragma once

#include <filesystem>
#include <string_view>
#include <system_error>

namespace ramus::app {

class Document;

namespace user_folders {

[[nodiscard]] std::filesystem::path home();     // $HOME, else what the system knows of this user
[[nodiscard]] std::filesystem::path settings(); // $XDG_CONFIG_HOME/ramus, else ~/.config/ramus
[[nodiscard]] std::filesystem::path state();    // $XDG_STATE_HOME/ramus, else ~/.local/state/ramus

// The person's own folders, as user-dirs.dirs names them; empty when they do not exist.
[[nodiscard]] std::filesystem::path pictures();
[[nodiscard]] std::filesystem::path documents();

// Makes it where it is not there, and closes it to other users. For folders that ramus alone writes to.
[[nodiscard]] std::error_code make_private(const std::filesystem::path& folder);

[[nodiscard]] bool writable(const std::filesystem::path& folder); // exists, and files can be made there

} // namespace user_folders

// Where what the document is saved as goes when nobody gave a name. Absolute.
//
// A session (".ramus.json"): the file that it came from or was saved to last; else beside the tree, where that cannot
// be written in the documents or home folder, under a name that no file has yet. Everything else (".png", ".csv"):
// beside the session file; without one in the pictures folder for a picture, beside the tree for the rest; never over
// another file.
[[nodiscard]] std::filesystem::path suggested_file(const Document& document, std::string_view extension);

} // namespace ramus::app
