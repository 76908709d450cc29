// Detects meshes in other axes than the vessels: LPS data that is read as RAS, or vice versa, is rotated by half a turn
// about z.
#pragma once

#include "core/tree/vessel_tree.h"
#include "render/scene/bounds.h"

#include <string>

namespace ramus::app {

// The extent of an object, and the origin of its axes.
struct Place {
    render::Box box;
    tree::SaidBy axes = tree::SaidBy::kNobody;
};

// Suggests an option if mesh and vessels (or another surface of them) do not overlap but would after a turn of 180
// degrees about z. Empty otherwise, and if both files state their axes. `option`: the one to suggest,
// "--mesh-orientation LPS".
[[nodiscard]] std::string half_turn_hint(const Place& mesh, const Place& vessels, const std::string& option);

// --mesh-orientation with the axes other than `read_in`.
[[nodiscard]] std::string other_axes_option(const std::string& read_in);

} // namespace ramus::app
