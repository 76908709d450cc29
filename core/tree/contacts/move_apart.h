// Where axes nearly cross, a wall midway between them would pinch both vessels. There the axes count as moved apart.
#pragma once

#include "core/tree/contacts/islands.h"
#include "core/tree/contacts/links.h"

#include <glm/vec3.hpp>
#include <span>

namespace ramus::tree {

// How far, and which way, the second vessel of a contact is to be moved from the first, mm: so that their axes are
// nowhere closer than kLeastDistance, or else as far apart as one short move in one direction can bring them. 0 where
// they need none.
[[nodiscard]] glm::dvec3 move_apart(const Links& links, std::span<const OrientedPair> pairs);

// In radii of the thinner vessel.
inline constexpr double kLeastDistance = 0.8;

} // namespace ramus::tree
