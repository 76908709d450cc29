// The options of `ramus cohort` that its steps pass on to other commands: each step gets those that its command has.
#pragma once

#include "app/commands/surface_flags.h"

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

namespace ramus::app {

// Adds all options of trees, masks and surfaces, but for those that concern a single case.
void add_cohort_surface_flags(CLI::App& command, SurfaceFlags& flags);

// The options that the command line gives, as {"--smooth": ["2"]}.
[[nodiscard]] nlohmann::ordered_json given_options(const CLI::App& command, const SurfaceFlags& flags);

// Their words for each kind of case and step: {"tree": {"measure": ["--smooth=2"], ...}, "mask": {...}}. The steps
// after skeletonize read the tree of a mask, which is in mm, so options of reading are left out there. `app`: has the
// commands of all steps.
[[nodiscard]] nlohmann::ordered_json step_options(CLI::App& app, const nlohmann::ordered_json& given);

// Whether the surface of a mask's tree is compared with the mask. A scan with a threshold is no mask to compare with.
[[nodiscard]] bool compares_masks(const nlohmann::ordered_json& given);

} // namespace ramus::app
