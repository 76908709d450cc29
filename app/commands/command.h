// What a file of app/commands that is named in subcommands.h does: it registers one subcommand and, when that was asked
// for, chooses what main shall do once the whole command line has been understood. An action returns the exit status,
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

// Of --overwrite, next to --commands.
inline constexpr const char* kOverwriteHelp =
    "The commands may replace files that were there before, and throw recovery files away";

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

// For CLI::Option::check(): a word that does not fit is wrong usage, "WORD is not ...".
template <class Fits> auto expecting(const std::string& what, const Fits& fits) {
    return [=](const std::string& word) { return fits(word) ? std::string() : word + what; };
}

template <class Value> inline constexpr bool kHoldsReals = std::is_floating_point_v<Value>;
template <class Value> inline constexpr bool kHoldsReals<std::optional<Value>> = kHoldsReals<Value>;
template <class Value, std::size_t N> inline constexpr bool kHoldsReals<std::array<Value, N>> = kHoldsReals<Value>;

// Ranges let NaN through, and nothing here means infinity. What is no number is told of where it is read.
template <class Value> CLI::Option* finite(CLI::Option* option) {
    if constexpr (kHoldsReals<Value>)
        option->check(expecting(" is not a finite number", [](const std::string& word) {
            double value = 0.0;
            return !CLI::detail::lexical_cast(word, value) || std::isfinite(value);
        }));
    return option;
}

// What a word of an option of inputs means: a path. Throws CLI::ValidationError when standard input is meant twice.
[[nodiscard]] std::string input_word(const std::string& word);
[[nodiscard]] bool reads_standard_input(); // a word meant it

// An option with a value; `type` stands for it in the help. Numbers are finite.
template <class Value>
CLI::Option* add_option(CLI::App& command, const std::string& name, const std::string& type, Value& value,
                        const std::string& help) {
    return finite<Value>(command.add_option(name, value, help)->type_name(type));
}

// The same, whose value `take` gets.
template <class Value, class Take>
CLI::Option* add_option_taking(CLI::App& command, const std::string& name, const std::string& type, const Take& take,
                               const std::string& help) {
    return finite<Value>(command.add_option_function<Value>(name, take, help)->type_name(type));
}

// An option whose words name what is read; "-" is standard input. One of all options of a command line may be that.
template <class Value>
CLI::Option* add_input(CLI::App& command, const std::string& name, const std::string& type, Value& value,
                       const std::string& help) {
    return add_option(command, name, type, value, help)->transform(std::function<std::string(std::string)>(input_word));
}

// The bytes that 800M, 4G or 123456 are, in powers of 1024; none: it is no such size, or more than any machine has.
[[nodiscard]] std::optional<std::uint64_t> memory_size(std::string_view word);

// An option of --memory's kind, in bytes; 0 is what `help` says of it.
template <class Bytes>
CLI::Option* add_memory_option(CLI::App& command, const std::string& name, Bytes& bytes, const std::string& help) {
    return add_option_taking<std::string>(
               command, name, "SIZE", [&bytes](const std::string& word) { bytes = Bytes(*memory_size(word)); }, help)
        ->check(expecting(" is not a size of memory, as 800M or 4G",
                          [](const std::string& word) { return memory_size(word).has_value(); }));
}

} // namespace ramus::app
