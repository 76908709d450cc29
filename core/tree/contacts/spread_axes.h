// Moves the axes of vessels in contact apart where they nearly cross. A wall midway between the real axes would pinch
// both vessels. The moved axes decide only where walls lie; kernels and centerlines keep their positions. All contacts
// of a tree are solved together, so that a vessel between two others keeps its distance from both.
#pragma once

#include "core/tree/contacts/contacts.h"
#include "core/tree/contacts/islands.h"
#include "core/tree/contacts/links.h"

#include <span>
#include <vector>

namespace ramus::tree {

// The move of each link (mm). Aims at a distance of kLeastDistance between the axes of each contact, by a fixed number
// of relaxation steps; not guaranteed where it would need larger moves. No point moves farther than kFarthestAside.
// Consecutive links stay joined. Empty if no axis has to be moved.
[[nodiscard]] std::vector<AxisMove> spread_axes(const Links& links, std::span<const Island> islands);

inline constexpr double kLeastDistance = 0.8; // in radii of the thinner vessel
inline constexpr double kFarthestAside = 0.6; // in radii of the moved vessel

} // namespace ramus::tree
