// ramus mesh --for-printing: what is thin, and where, in words and as JSON.
#pragma once

#include "app/commands/write_surface.h"
#include "app/session/thickness_text.h"

#include <CLI/CLI.hpp>
#include <nlohmann/json_fwd.hpp>
#include <span>

namespace ramus::app {

struct PrintingFlags {
    bool wanted = false;
    double thinnest_mm = kThinnestPrintedMm;
};

// --for-printing and --thinnest.
void add_printing_flags(CLI::App& command, PrintingFlags& flags);

// closed, units, thinnest {mm, at, branch}, thin_below_mm, and thin: the branches below that, the thinnest first.
[[nodiscard]] nlohmann::ordered_json
printing_json(const PrintingFlags& flags, std::span<const measure::Thickness> thicknesses, const tree::Claims& claims);

// On standard error: what is thinner than it should be, and that several pieces come out of the printer, if so.
void warn_about_printing(const PrintingFlags& flags, const WrittenSurface& written, const tree::Claims& claims);

} // namespace ramus::app
