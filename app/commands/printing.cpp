#include "app/commands/printing.h"

#include "app/commands/command.h"
#include "app/session/numbers.h"

#include <cmath>
#include <iostream>
#include <nlohmann/json.hpp>

namespace ramus::app {

namespace {

using measure::Thickness;

nlohmann::ordered_json json_of(const Thickness& thickness) {
    nlohmann::ordered_json json = {{"mm", thickness.mm}, {"at", {thickness.at.x, thickness.at.y, thickness.at.z}}};
    if (thickness.branch != tree::kNoBranch) json["branch"] = thickness.branch;
    return json;
}

} // namespace

void add_printing_flags(CLI::App& command, PrintingFlags& flags) {
    CLI::Option* wanted = command.add_flag(
        "--for-printing", flags.wanted,
        "Make sure that the surface is closed and in mm, and say how thin it is at its thinnest place, and where");
    command.add_option("--thinnest", flags.thinnest_mm, "With --for-printing: warn of what is thinner (default 0.8)")
        ->type_name("MM")
        ->needs(wanted)
        ->check(expecting(" is not a positive number of mm", [](const std::string& text) {
            double value = 0.0;
            return CLI::detail::lexical_cast(text, value) && std::isfinite(value) && value > 0.0;
        }));
}

nlohmann::ordered_json printing_json(const PrintingFlags& flags, std::span<const Thickness> thicknesses,
                                     const tree::Claims& claims) {
    nlohmann::ordered_json json = {{"closed", true}, {"units", claims.unit_word()}};
    if (!thicknesses.empty()) json["thinnest"] = json_of(thicknesses.front());
    json["thin_below_mm"] = flags.thinnest_mm;
    json["thin"] = nlohmann::ordered_json::array();
    for (const Thickness& thin : thinner_than(thicknesses, flags.thinnest_mm)) json["thin"].push_back(json_of(thin));
    return json;
}

void warn_about_printing(const PrintingFlags& flags, const WrittenSurface& written, const tree::Claims& claims) {
    if (!claims.has_unit())
        std::cerr << "ramus: the unit of the tree is not known, and printers take it for 1 mm; give it with --units\n";
    if (const std::string thin = thin_text(written.thicknesses, flags.thinnest_mm, Lengths(claims)); !thin.empty())
        std::cerr << "ramus: " << thin
                  << "; print it larger, leave thin vessels out with --prune or hidden in a --session, or give with "
                     "--thinnest what your printer can print\n";
    if (written.shape.pieces > 1)
        std::cerr << "ramus: "
                  << counted(static_cast<std::uint64_t>(written.shape.pieces), "piece comes", "pieces come")
                  << " out of the printer: what is not connected falls apart\n";
}

} // namespace ramus::app
