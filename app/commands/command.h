// What a file of app/commands that is named in subcommands.h does: it registers one subcommand and, when that was asked
// for, chooses what main shall do once the whole command line has been understood. An action returns the exit status,
// or an Error that main prints.
//
// Exit status: 0 done, 1 failed, 2 wrong usage, 3 a comparison exceeded its tolerance.
#pragma once

#include "core/base/error.h"

#include <CLI/CLI.hpp>
#include <functional>

namespace ramus::app {

inline constexpr int kDone = 0;
inline constexpr int kFailed = 1;
inline constexpr int kWrongUsage = 2;
inline constexpr int kBeyondTolerance = 3;

using Action = std::function<Result<int>()>;

// A subcommand with the flags that every one has.
inline CLI::App* add_command(CLI::App& app, const std::string& name, const std::string& description) {
    CLI::App* command = app.add_subcommand(name, description);
    command->set_version_flag("--version", "ramus " RAMUS_VERSION);
    return command;
}

// An option with a value; `type` stands for it in the help.
template <class Value>
CLI::Option* add_option(CLI::App& command, const std::string& name, const std::string& type, Value& value,
                        const std::string& help) {
    return command.add_option(name, value, help)->type_name(type);
}

// The same, whose value `take` gets.
template <class Value, class Take>
CLI::Option* add_option_taking(CLI::App& command, const std::string& name, const std::string& type, const Take& take,
                               const std::string& help) {
    return command.add_option_function<Value>(name, take, help)->type_name(type);
}

// For CLI::Option::check(): a word that does not fit is wrong usage, "WORD is not ...".
template <class Fits> auto expecting(const std::string& what, const Fits& fits) {
    return [=](const std::string& word) { return fits(word) ? std::string() : word + what; };
}

} // namespace ramus::app
