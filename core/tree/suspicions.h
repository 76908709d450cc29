// What a tree of vessels has seldom, and a damaged or misread file often: radii that nobody measured, that jump or are
// absurd, loops, pieces that nothing connects. Nothing is refused for it; each place gets a note, so that a person can
// look at it.
#pragma once

#include "core/tree/build_tree.h"

#include <optional>
#include <string_view>
#include <vector>

namespace ramus::tree {

// A radius that is this many times larger, or smaller, than those beside it is no vessel's.
inline constexpr double kRadiusJump = 3.0;
// The end of a vessel may taper as far as this.
inline constexpr double kRadiusTaper = 50.0;
// From one point of a vessel to the next: radii in steps of half a voxel go to the threefold at once.
inline constexpr double kRadiusStep = 5.0;
// Vessels of one tree differ by this much at most: the aorta is three thousand times as wide as a capillary.
inline constexpr double kThinnestOfThickest = 1e-4;

// A tree with a larger share of radii that nobody measured is suspect.
inline constexpr double kMostInvented = 0.1;
// The topic of that suspicion, which is reported before all others.
inline constexpr std::string_view kInventedRadii = "invented-radii";

// A note if more than kMostInvented of the radii are invented.
[[nodiscard]] std::optional<Note> check_invented(std::size_t invented, std::size_t points);

// Notes of radii that stand kRadiusJump apart from those of all their neighbours (ends: kRadiusTaper below them), or
// kRadiusStep from the next one; and of those that are larger than all of their piece is long, or kThinnestOfThickest
// of the thickest. With `mend`, the radius of a point between two others that differs so from both becomes their mean
// (topic "radius-jumps").
[[nodiscard]] std::vector<Note> check_radii(std::vector<Point>& points, const std::vector<Edge>& edges, bool mend);

// Notes of the branches that close a loop, one for each loop, and of the pieces beside the longest of each system.
[[nodiscard]] std::vector<Note> check_network(const VesselTree& tree);

} // namespace ramus::tree
