// The numbers and words that a surface is made with, one row each: the command line's flags, sessions, the `surface`
// command and the sliders of the window all read this table, so that an option is a member of mesh::SurfaceOptions and
// a row.
#pragma once

#include "core/mesh/surface_options.h"

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace ramus::app {

// One of the words of an option that takes no number.
struct OptionWord {
    std::string_view key;   // on the command line, in sessions and commands
    std::string_view label; // in the window
};

struct SurfaceOption {
    std::string_view key;    // "smooth": --smooth, in a session's options, `surface smooth 2`
    std::string_view unit;   // what the value is called in --help
    std::string_view help;   // in --help, without the flag
    std::string_view domain; // "a whole number from 0 to 100"
    double least, most;
    bool whole = false;      // only whole numbers
    bool of_session = false; // saved, and covered by undo; else the machine's business
    double (*value)(const mesh::SurfaceOptions&) = nullptr;
    void (*set)(mesh::SurfaceOptions&, double) = nullptr;
    // The slider; without a label there is none, and the option cannot be set by command.
    std::string_view label{};
    std::string_view tooltip{};
    double slider_least = 0.0, slider_most = 0.0;
    bool zero_is_off = false;            // shown as "off"
    std::string_view instead{};          // the option that this one replaces on the command line
    bool only_when_set = false;          // in sessions and in the window: left out at its default
    std::span<const OptionWord> words{}; // its values, from 0, have names; empty: it is a number
    // What surfaces were made with before there was the option: of sessions that have options, but not this one. None:
    // they were made as by default.
    std::optional<double> before_it_was{};
};

[[nodiscard]] std::span<const SurfaceOption> surface_options();
[[nodiscard]] const SurfaceOption* surface_option(std::string_view key); // null: none of this name

// Whether the option takes it: finite, within its domain, whole where that is asked for.
[[nodiscard]] bool takes(const SurfaceOption& option, double value);

// A value as commands and files spell it, "4" or "tree", and back; none: the option does not take it.
[[nodiscard]] std::string spelled(const SurfaceOption& option, double value);
[[nodiscard]] std::optional<double> value_in(const SurfaceOption& option, const std::string& text);

// "smooth 0 to 100, prune from 0, ..." and the methods: what the `surface` command takes.
[[nodiscard]] std::string surface_command_help();

} // namespace ramus::app
