// What was meant by a sub-command or an option that does not exist.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace ramus::app {

[[nodiscard]] bool is_command(const CLI::App& app, const std::string& word);

// Of `app`, whose sub-commands `word` is none of: "mehs: neither a command nor a file; did you mean mesh?".
[[nodiscard]] std::string unknown_command(const CLI::App& app, const std::string& word);

// For CLI::App::failure_message(): what went wrong, of options that are not known what may have been meant, and where
// to read more.
[[nodiscard]] std::string failure_text(const CLI::App* app, const CLI::Error& error);

} // namespace ramus::app
