// Names and colours of the parts of a surface, for file formats that store them.
#pragma once

#include "app/assets/plan.h"
#include "app/session/session.h"
#include "core/io/meshes/mesh_names.h"

#include <optional>
#include <string_view>

namespace ramus::app {

// Parses "none", "system" or "branch".
[[nodiscard]] std::optional<io::PartsBy> parts_named(std::string_view word);

// The default: parts are systems if the tree has any, otherwise branches.
[[nodiscard]] io::PartsBy usual_parts(const tree::VesselTree& tree);

// Colours: those of the picture per branch, otherwise the session's colours of systems, otherwise the default colour of
// vessels. Names: the branch's label, otherwise its number ("branch 12"). `plan`: of the same marks; null: no lesions
// and cuts.
[[nodiscard]] io::MeshNames surface_names(const tree::VesselTree& tree, const TreeFacts& facts, const Marks& marks,
                                          const Plan* plan, io::PartsBy by);

} // namespace ramus::app
