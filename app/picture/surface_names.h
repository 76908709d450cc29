// What the parts of a surface are called and how they are coloured when it is written to a file that can say so.
#pragma once

#include "app/assets/plan.h"
#include "app/session/session.h"
#include "core/io/meshes/mesh_names.h"

#include <optional>
#include <string_view>

namespace ramus::app {

// "none", "system", "branch"; none: no such word.
[[nodiscard]] std::optional<io::PartsBy> parts_named(std::string_view word);

// A part for each system of a tree that has systems, else for each branch.
[[nodiscard]] io::PartsBy usual_parts(const tree::VesselTree& tree);

// The colours of the picture (of branches as a whole); where it has none, those of the systems as the session has
// them; else the vessels'.
// Branches have their names, or bear that of what they depend on, or a number alone: "branch 12". `plan`: of the same
// marks; null: as without lesions and cuts.
[[nodiscard]] io::MeshNames surface_names(const tree::VesselTree& tree, const TreeFacts& facts, const Marks& marks,
                                          const Plan* plan, io::PartsBy by);

} // namespace ramus::app
