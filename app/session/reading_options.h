// Options for reading a tree's file as text: on the command line, in commands, in sessions.
#pragma once

#include "core/base/error.h"
#include "core/io/trees/imported_tree.h"
#include "core/tree/vessel_tree.h"

#include <optional>
#include <string>
#include <string_view>

namespace ramus::app {

[[nodiscard]] std::string repair_names();                                      // "zero-radii,repeated-points,..."
[[nodiscard]] std::optional<tree::Repair> repairs_in(const std::string& list); // "usual", "all", "none", or names
[[nodiscard]] std::string spelled(tree::Repair repair);                        // the inverse
[[nodiscard]] std::string spelled(const io::LengthUnit& unit);                 // "cm", "0.3x0.3x0.6": exact
[[nodiscard]] std::string_view spelled(io::RadiusIs width);                    // "radius", "diameter"
[[nodiscard]] std::optional<io::RadiusIs> width_in(std::string_view text);

// The number of a channel or a time point, from 1. None: the text is none.
[[nodiscard]] std::optional<int> part_number(std::string_view text);

inline constexpr double kLeastRadius = 1e-6; // mm; smallest value of the option `radius`

// Returns `options` with one of them changed. Keys: units, radius-is, radius, orientation (older name: axes), repair,
// data (an existing file), channel and time (whole numbers from 1) and those of masks (mask_reading.h); "auto" resets
// to the file's own statement, or to the default. Errors say what the key takes.
[[nodiscard]] Result<io::ReadOptions> with(io::ReadOptions options, std::string_view key, const std::string& value);

// Merges options: those specified in `said` override the session's. Default repairs do not override.
[[nodiscard]] io::ReadOptions over(const io::ReadOptions& said, io::ReadOptions session);

// The label of a note's topic: "Radii of 0".
[[nodiscard]] std::string topic_label(std::string_view topic);

// Whether the tree could mislead a person who is not warned: the unit is implausible, a width may be radius or
// diameter, or radii, vessels or points were changed.
[[nodiscard]] bool could_mislead(const tree::Note& note, const io::ReadOptions& options);
[[nodiscard]] bool could_mislead(const tree::VesselTree& tree, const io::ReadOptions& options);

} // namespace ramus::app
