// Roles of vessel systems, guessed from their names, for people to confirm.
#pragma once

#include "core/organ/remnant.h"
#include "core/tree/vessel_tree.h"

#include <span>
#include <vector>

namespace ramus::organ {

// By system; one for a tree without systems. A vein drains, except the portal vein; everything else supplies.
[[nodiscard]] std::vector<Role> roles_by_name(std::span<const tree::System> systems);

} // namespace ramus::organ
