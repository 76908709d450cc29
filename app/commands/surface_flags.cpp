#include "app/commands/surface_flags.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

namespace ramus::app {

namespace {

constexpr double kNoLimit = std::numeric_limits<double>::infinity();

// Finite numbers from `least` to `most`; CLI::Range would let NaN through.
CLI::Validator number_between(double least, double most, const std::string& domain) {
    return {[=](std::string& text) -> std::string {
                double value = 0.0;
                if (!CLI::detail::lexical_cast(text, value) || !std::isfinite(value) || value < least || value > most)
                    return text + " is not " + domain;
                return {};
            },
            ""};
}

std::string repair_names() {
    std::string names;
    for (const auto& [repair, name] : tree::kRepairNames) names += (names.empty() ? "" : ",") + std::string(name);
    return names;
}

std::optional<tree::Repair> repairs_in(const std::string& list) {
    if (list == "all") return tree::Repair::kAll;
    if (list == "none") return tree::Repair::kNone;
    tree::Repair chosen = tree::Repair::kNone;
    for (const std::string& word : CLI::detail::split(list, ',')) {
        const auto* const known =
            std::ranges::find_if(tree::kRepairNames, [&](const auto& entry) { return word == entry.second; });
        if (known == std::end(tree::kRepairNames)) return std::nullopt;
        chosen = chosen | known->first;
    }
    return chosen;
}

} // namespace

void add_reading_flags(CLI::App& command, SurfaceFlags& flags) {
    command
        .add_option_function<std::string>(
            "--repair", [&flags](const std::string& list) { flags.read.repair = *repairs_in(list); },
            "What to mend in a damaged tree: all (default), none, or some of " + repair_names())
        ->type_name("LIST")
        ->check(CLI::Validator(
            [](std::string& list) -> std::string {
                return repairs_in(list) ? "" : list + " is not all, none, or a list of " + repair_names();
            },
            ""));
    command.add_flag("--verbose", flags.verbose, "Say on standard error what is going on");
}

mesh::SurfaceOptions SurfaceFlags::over(mesh::SurfaceOptions session) const {
    const auto given = [&](const char* name) {
        const CLI::Option* option = command->get_option_no_throw(name);
        return option != nullptr && option->count() > 0;
    };
    if (given("--method")) session.method = surface.method;
    if (given("--smooth")) session.smooth_passes = surface.smooth_passes;
    if (given("--prune")) session.prune_ratio = surface.prune_ratio;
    if (given("--width")) session.width = surface.width;
    if (given("--detail")) session.detail = surface.detail, session.cell_mm = 0.0;
    if (given("--cell")) session.cell_mm = surface.cell_mm;
    session.threads = surface.threads; // the machine's business, not the session's
    session.memory_bytes = surface.memory_bytes;
    return session;
}

void add_surface_flags(CLI::App& command, SurfaceFlags& flags) {
    flags.command = &command;
    mesh::SurfaceOptions& surface = flags.surface;
    command.add_option("--smooth", surface.smooth_passes, "Smoothing passes over points and radii (default 1)")
        ->type_name("N")
        ->check(number_between(0, 100, "a whole number from 0 to 100"));
    command
        .add_option("--prune", surface.prune_ratio, "Drop end branches shorter than RATIO x their parent (default 0)")
        ->type_name("RATIO")
        ->check(number_between(0.0, kNoLimit, "a ratio of 0 or more"));
    // Beyond these, the isovalue 2^-width leaves single precision, or the support (10 radii) covers the whole tree.
    command
        .add_option("--width", surface.width,
                    "Kernel width; 5 follows the vessels (default), 1 blends as Bloomenthal did")
        ->type_name("WIDTH")
        ->check(number_between(0.1, 100.0, "a width from 0.1 to 100"));
    CLI::Option* detail =
        command.add_option("--detail", surface.detail, "Triangles around a vessel, thick or thin (default 16)")
            ->type_name("N")
            ->check(number_between(4, 512, "a whole number from 4 to 512"));
    command.add_option("--cell", surface.cell_mm, "One cell size everywhere, in mm, instead of --detail")
        ->type_name("MM")
        ->check(number_between(std::numeric_limits<float>::min(), kNoLimit, "a length above 0"))
        ->excludes(detail);
    command.add_option("--threads", surface.threads, "Threads to work with (default 0: one for each core)")
        ->type_name("N")
        ->check(number_between(0, 1024, "a whole number from 0 to 1024"));
    command
        .add_option("--memory", surface.memory_bytes,
                    "Most memory to use, as 800M or 4G (default 0: half of the machine's); ramus mesh streams larger "
                    "surfaces to the disk")
        ->type_name("SIZE")
        ->transform(CLI::AsSizeValue(false));
    add_reading_flags(command, flags);
}

} // namespace ramus::app
