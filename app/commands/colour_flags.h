// --colour-by and how its colours follow: flags of `ramus render`.
#pragma once

#include "app/session/session.h"
#include "core/base/error.h"
#include "core/tree/vessel_tree.h"

#include <CLI/CLI.hpp>
#include <string>

namespace ramus::app {

// What colours say and how; what is empty is as the session has it.
struct ColourFlags {
    std::string by, map, range, logarithm, legend;
};

// --colour-by QUANTITY, of those that the command of this name takes, and how: --colour-map, --colour-range,
// --colour-log, --legend.
void add_colour_flags(CLI::App& command, ColourFlags& colours);

// What they say becomes the session's. Fails where `tree` has no such data, and on a range that makes no sense.
[[nodiscard]] Result<void> apply(const ColourFlags& flags, const tree::VesselTree& tree, Marks& marks);

} // namespace ramus::app
