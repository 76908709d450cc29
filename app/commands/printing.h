// `ramus mesh --for-printing`: reports where a surface is too thin for a 3D printer, as text and as JSON.
#pragma once

#include "app/commands/write_surface.h"
#include "app/session/thickness_text.h"

#include <CLI/CLI.hpp>
#include <nlohmann/json_fwd.hpp>
#include <span>

namespace ramus::app {

struct PrintingFlags {
    bool wanted = false;                     // --for-printing
    double thinnest_mm = kThinnestPrintedMm; // --thinnest: thinner places get a warning
};

// Adds --for-printing and --thinnest to `command`; parsing writes to `flags`, which must live as long as the command.
void add_printing_flags(CLI::App& command, PrintingFlags& flags);

// An object with the members closed, units, thinnest {mm, at, branch}, thin_below_mm, and thin: a list of the branches
// that are thinner than this limit, the thinnest first. `thicknesses`: from measure::least_thicknesses().
[[nodiscard]] nlohmann::ordered_json
printing_json(const PrintingFlags& flags, std::span<const measure::Thickness> thicknesses, const tree::Claims& claims);

// Warns on standard error of an unknown unit, of places that are too thin, and of a surface in several pieces.
void warn_about_printing(const PrintingFlags& flags, const WrittenSurface& written, const tree::Claims& claims);

} // namespace ramus::app
