// The vessel systems of a tree (portal vein, hepatic vein, artery) with the session's names and colours, which are the
// file's until a person changes one. A system is hidden if all its branches are.
#pragma once

#include "app/session/branch_facts.h"
#include "app/session/session.h"
#include "core/base/error.h"

#include <glm/vec3.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace ramus::app {

using Systems = std::vector<tree::System>;

// One entry per system of the tree; empty if it has none.
[[nodiscard]] const Systems& systems_of(const tree::VesselTree& tree, const Marks& marks);
// Sets names and colours, in the session's canonical form.
void set_systems(Marks& marks, Systems systems, const tree::VesselTree& tree);
// The tree with the session's names and colours, for writing it to a file.
[[nodiscard]] tree::VesselTree with_systems(tree::VesselTree tree, const Marks& marks);

// "portal vein", or "system 2" without a name; empty if the tree has no systems.
[[nodiscard]] std::string system_name(const Systems& systems, int system);
[[nodiscard]] std::string system_of(const tree::VesselTree& tree, const Marks& marks, int branch);
// sRGB. Black means "not set"; the system then gets one of a few distinguishable colours.
[[nodiscard]] glm::vec3 shown_colour(const Systems& systems, int system);

// Finds a system by its name, ignoring case, or by its number, counted from 1.
[[nodiscard]] Result<int> find_system(const Systems& systems, std::string_view word);
[[nodiscard]] std::vector<int> branches_in_system(const tree::VesselTree& tree, int system); // ascending

struct SystemFacts {
    int branches = 0, visible = 0;
    double length_mm = 0.0, volume_mm3 = 0.0;
};
[[nodiscard]] std::vector<SystemFacts> system_facts(const tree::VesselTree& tree, const TreeFacts& facts,
                                                    const Marks& marks);

// The initial colouring of a tree: by system if it has several, otherwise `wanted`.
[[nodiscard]] ColourBy first_colouring(ColourBy wanted, const tree::VesselTree& tree);

} // namespace ramus::app
