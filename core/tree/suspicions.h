// Finds features that are rare in real vessels and frequent in damaged or misread files: invented radii, radii that
// jump or are implausible, loops, and unconnected pieces. Each place gets a note for the user; no tree is refused for
// it.
#pragma once

#include "core/tree/build_tree.h"

#include <optional>
#include <string_view>
#include <vector>

namespace ramus::tree {

// A radius is suspicious if it differs from those of all its neighbours by this factor.
inline constexpr double kRadiusJump = 3.0;
// The end of a vessel may be thinner than its neighbour by up to this factor.
inline constexpr double kRadiusTaper = 50.0;
// The largest factor between consecutive points. Radii in steps of half a voxel can triple from point to point.
inline constexpr double kRadiusStep = 5.0;
// The least plausible ratio of two radii of one tree: the aorta is three thousand times as wide as a capillary.
inline constexpr double kThinnestOfThickest = 1e-4;

// A tree is suspicious if more than this share of its radii was not measured.
inline constexpr double kMostInvented = 0.1;
// The topic of this suspicion, which is reported before all others.
inline constexpr std::string_view kInventedRadii = "invented-radii";

// Returns a note if more than kMostInvented of the radii are invented.
[[nodiscard]] std::optional<Note> check_invented(std::size_t invented, std::size_t points);

// Notes of suspicious radii: radii that differ from those of all neighbours by kRadiusJump (at ends: that are smaller
// by kRadiusTaper) or from the next one by kRadiusStep; radii larger than the length of their whole piece; and radii
// below kThinnestOfThickest of the thickest one. With `repair`, the radius of a point between two others that differs
// from both by kRadiusJump becomes their mean (topic "radius-jumps").
[[nodiscard]] std::vector<Note> check_radii(std::vector<Point>& points, const std::vector<Edge>& edges, bool repair);

// Notes of the branches that close a loop, one for each loop, and of all pieces but the longest one of each system.
[[nodiscard]] std::vector<Note> check_network(const VesselTree& tree);

} // namespace ramus::tree
