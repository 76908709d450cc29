// Suggests subcommands and options for misspelled ones.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace ramus::app {

// Whether `word` is the name of a subcommand of `app`.
[[nodiscard]] bool is_command(const CLI::App& app, const std::string& word);

// The message for a word that is not a subcommand of `app`: "mehs: neither a command nor a file; did you mean mesh?".
[[nodiscard]] std::string unknown_command(const CLI::App& app, const std::string& word);

// The message of a usage error, for CLI::App::failure_message(): the error, suggestions for unknown options, and the
// command that prints the help.
[[nodiscard]] std::string failure_text(const CLI::App* app, const CLI::Error& error);

} // namespace ramus::app
