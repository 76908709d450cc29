// Building blocks of subcommands. Each subcommand has a file in app/commands with a register function, which
// subcommands.h lists. The register function adds the subcommand and its options to the CLI::App. Parsing the
// subcommand sets the Action that main runs once the whole command line is parsed. An action returns the exit status,
// or an Error that main prints.
//
// Exit status: 0 done, 1 failed, 2 wrong usage, 3 a comparison exceeded its tolerance.
#pragma once

#include "core/base/error.h"

#include <CLI/CLI.hpp>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>

namespace ramus::app {

// The help text of --overwrite, the option that goes with --commands.
inline constexpr const char* kOverwriteHelp = "The commands may replace existing files and discard recovery files";

inline constexpr int kDone = 0;
inline constexpr int kFailed = 1;
inline constexpr int kWrongUsage = 2;
inline constexpr int kBeyondTolerance = 3;

using Action = std::function<Result<int>()>;

// Adds a subcommand with the flags that all subcommands have.
inline CLI::App* add_command(CLI::App& app, const std::string& name, const std::string& description) {
    CLI::App* command = app.add_subcommand(name, description);
    command->set_version_flag("--version", "ramus " RAMUS_VERSION);
    return command;
}

// A check for CLI::Option::check(). A word for which `fits` is false is wrong usage; the message is the word followed
// by `what`, for example "WORD is not ...".
template <class Fits> auto expecting(const std::string& what, const Fits& fits) {
    return [=](const std::string& word) { return fits(word) ? std::string() : word + what; };
}

template <class Value> inline constexpr bool kHoldsReals = std::is_floating_point_v<Value>;
template <class Value> inline constexpr bool kHoldsReals<std::optional<Value>> = kHoldsReals<Value>;
template <class Value, std::size_t N> inline constexpr bool kHoldsReals<std::array<Value, N>> = kHoldsReals<Value>;

// Adds a check that values are finite: CLI::Range accepts NaN, and no option accepts infinity. The check accepts words
// that are not numbers, since CLI11 reports them itself.
template <class Value> CLI::Option* finite(CLI::Option* option) {
    if constexpr (kHoldsReals<Value>)
        option->check(expecting(" is not a finite number", [](const std::string& word) {
            double value = 0.0;
            return !CLI::detail::lexical_cast(word, value) || std::isfinite(value);
        }));
    return option;
}

// The path of an input that is named by `word`: "-" and /dev/stdin become io::kStandardInputPath. Throws
// CLI::ValidationError if the command line names standard input twice.
[[nodiscard]] std::string input_word(const std::string& word);
[[nodiscard]] bool reads_standard_input(); // whether the command line names standard input

// Adds an option with a value. `type` is how --help writes the value, as "MM". Numbers must be finite.
template <class Value>
CLI::Option* add_option(CLI::App& command, const std::string& name, const std::string& type, Value& value,
                        const std::string& help) {
    return finite<Value>(command.add_option(name, value, help)->type_name(type));
}

// Adds an option whose parsed value is passed to `take`.
template <class Value, class Take>
CLI::Option* add_option_taking(CLI::App& command, const std::string& name, const std::string& type, const Take& take,
                               const std::string& help) {
    return finite<Value>(command.add_option_function<Value>(name, take, help)->type_name(type));
}

// Adds an option that names input files; "-" is standard input, which a command line can name only once.
template <class Value>
CLI::Option* add_input(CLI::App& command, const std::string& name, const std::string& type, Value& value,
                       const std::string& help) {
    return add_option(command, name, type, value, help)->transform(std::function<std::string(std::string)>(input_word));
}

// The number of bytes of a size such as 800M, 4G or 123456; prefixes are powers of 1024. Nothing if `word` is not a
// size, or more than 2^50 bytes.
[[nodiscard]] std::optional<std::uint64_t> memory_size(std::string_view word);

// Adds an option for an amount of memory, in bytes. `help` must say what 0 means.
template <class Bytes>
CLI::Option* add_memory_option(CLI::App& command, const std::string& name, Bytes& bytes, const std::string& help) {
    return add_option_taking<std::string>(
               command, name, "SIZE", [&bytes](const std::string& word) { bytes = Bytes(*memory_size(word)); }, help)
        ->check(expecting(" is not a size of memory, as 800M or 4G",
                          [](const std::string& word) { return memory_size(word).has_value(); }));
}

} // namespace ramus::app
