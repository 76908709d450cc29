// The options of `ramus render` that choose which quantity colours show, and how: --colour-by, --colour-map,
// --colour-range, --colour-log and --legend.
#pragma once

#include "app/session/session.h"
#include "core/base/error.h"
#include "core/tree/vessel_tree.h"

#include <CLI/CLI.hpp>
#include <string>

namespace ramus::app {

// The values of the options, as the command line has them. Empty: not given, the session's value applies.
struct ColourFlags {
    std::string by, map, range, logarithm, legend;
};

// Adds the options to `command`; parsing writes to `colours`, which must live as long as the command. Values outside an
// option's domain are wrong usage, except the name of --colour-by, which apply() checks against the tree.
void add_colour_flags(CLI::App& command, ColourFlags& colours);

// Sets the given options in `marks`. Fails if `tree` has no data of the name in --colour-by, or if the range is invalid
// for a logarithmic scale.
[[nodiscard]] Result<void> apply(const ColourFlags& flags, const tree::VesselTree& tree, Marks& marks);

} // namespace ramus::app
