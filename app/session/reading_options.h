// How a tree's file is read, as people write it: on the command line, in commands, in sessions.
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

inline constexpr double kLeastRadius = 1e-6; // mm, that all points of a tree can be given

// `options` with one of them changed. Keys: units, radius-is, radius, orientation (axes is its older name), repair,
// data (a file, which must be there) and those of masks (mask_reading.h); "auto" leaves the answer to the file, or to
// what is usual. Fails with what the key takes.
[[nodiscard]] Result<io::ReadOptions> with(io::ReadOptions options, std::string_view key, const std::string& value);

// What a session asks for, but for what somebody says now: repairs that are the usual ones say nothing.
[[nodiscard]] io::ReadOptions over(const io::ReadOptions& said, io::ReadOptions session);

// What the topic of a note is called by people: "Radii of 0".
[[nodiscard]] std::string topic_label(std::string_view topic);

// Whether who looks at the tree without a word could take it for something else: its unit is unlikely, a width may be
// either of two things, or radii, vessels or points were changed.
[[nodiscard]] bool could_mislead(const tree::Note& note, const io::ReadOptions& options);
[[nodiscard]] bool could_mislead(const tree::VesselTree& tree, const io::ReadOptions& options);

} // namespace ramus::app
