// The table of surface options. The command line's flags, sessions, the `surface` command and the window's sliders all
// read it, so a new option needs only a member of mesh::SurfaceOptions and a row.
#pragma once

#include "core/mesh/surface_options.h"

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace ramus::app {

// A named value of an option that takes no number.
struct OptionWord {
    std::string_view key;   // on the command line, in sessions and commands
    std::string_view label; // in the window
};

struct SurfaceOption {
    std::string_view key;    // "smooth": --smooth, in a session's options, `surface smooth 2`
    std::string_view unit;   // how --help writes the value, as "MM" or "tree|paper"
    std::string_view help;   // in --help, without the flag
    std::string_view domain; // "a whole number from 0 to 100"
    double least, most;
    bool whole = false;      // only whole numbers
    bool of_session = false; // saved and covered by undo; false: a setting of the machine
    double (*value)(const mesh::SurfaceOptions&) = nullptr;
    void (*set)(mesh::SurfaceOptions&, double) = nullptr;
    // The slider. Without a label there is no slider, and no command can set the option.
    std::string_view label{};
    std::string_view tooltip{};
    double slider_least = 0.0, slider_most = 0.0;
    bool zero_is_off = false;            // shown as "off"
    std::string_view instead{};          // the option it replaces on the command line
    bool only_when_set = false;          // omitted in sessions and the window at its default
    std::span<const OptionWord> words{}; // names of the values 0, 1, ...; empty: a number
    // The value for older sessions that have options but not this one; none: the default.
    std::optional<double> before_it_was{};
};

[[nodiscard]] std::span<const SurfaceOption> surface_options();
[[nodiscard]] const SurfaceOption* surface_option(std::string_view key); // null: no such option

// Whether the value is valid: finite, within the domain, and an integer if required.
[[nodiscard]] bool takes(const SurfaceOption& option, double value);

// Converts a value to text, "4" or "tree", and back; none: invalid.
[[nodiscard]] std::string spelled(const SurfaceOption& option, double value);
[[nodiscard]] std::optional<double> value_in(const SurfaceOption& option, const std::string& text);

// The arguments of the `surface` command: "smooth 0 to 100, prune from 0, ..." and the methods.
[[nodiscard]] std::string surface_command_help();

} // namespace ramus::app
