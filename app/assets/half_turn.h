// Meshes in other axes than the vessels: LPS that is taken as RAS, or the other way round, lies half a turn about z
// away.
#pragma once

#include "core/tree/vessel_tree.h"
#include "render/scene/bounds.h"

#include <string>

namespace ramus::app {

// Where something lies, and who says where its axes lead.
struct Place {
    render::Box box;
    tree::SaidBy axes = tree::SaidBy::kNobody;
};

// What to do where the mesh and the vessels (or another surface of them) have nothing in common, and would have
// something if one of both were turned by 180 degrees about z: a sentence that names the option. Empty: they do, or
// would not, or both files state their axes. `option`: for the mesh, "--mesh-orientation LPS".
[[nodiscard]] std::string half_turn_hint(const Place& mesh, const Place& vessels, const std::string& option);

// --mesh-orientation with the other axes than the mesh was read in.
[[nodiscard]] std::string other_axes_option(const std::string& read_in);

} // namespace ramus::app
