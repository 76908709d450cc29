// Where axes nearly cross, a wall midway between them would pinch both vessels. There the axes count as moved apart:
// all of a tree's at once, so that a vessel between two others keeps away from both.
#pragma once

#include "core/tree/contacts/contacts.h"
#include "core/tree/contacts/islands.h"
#include "core/tree/contacts/links.h"

#include <span>
#include <vector>

namespace ramus::tree {

// How far the ends of each link count as moved, mm, so that the axes of contacts are kLeastDistance apart, or as far as
// that takes no axis farther than kFarthestAside from where it is. Consecutive links stay joined. Empty where no axis
// has to be moved.
[[nodiscard]] std::vector<AxisMove> spread_axes(const Links& links, std::span<const Island> islands);

// In radii of the thinner vessel.
inline constexpr double kLeastDistance = 0.8;
// In radii of the vessel itself.
inline constexpr double kFarthestAside = 0.6;

} // namespace ramus::tree
