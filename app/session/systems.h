// The systems of a tree (portal vein, hepatic vein, artery) as a session has them: named and coloured as the file has
// them, until a person renames or recolours one. A system is hidden when all of its branches are.
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

// One each for the tree's; empty where it has none.
[[nodiscard]] const Systems& systems_of(const tree::VesselTree& tree, const Marks& marks);
// Other names or colours for them, as the session keeps them.
void set_systems(Marks& marks, Systems systems, const tree::VesselTree& tree);
// The tree with the session's names and colours: what is written of it.
[[nodiscard]] tree::VesselTree with_systems(tree::VesselTree tree, const Marks& marks);

// "portal vein"; of one without a name "system 2". Empty where there are none.
[[nodiscard]] std::string system_name(const Systems& systems, int system);
[[nodiscard]] std::string system_of(const tree::VesselTree& tree, const Marks& marks, int branch);
// sRGB. Black, which no background lets see, is no choice of anybody: one of a few colours that are told apart.
[[nodiscard]] glm::vec3 shown_colour(const Systems& systems, int system);

// The one that a person means by a name, whatever its case, or by its number, counted from 1.
[[nodiscard]] Result<int> find_system(const Systems& systems, std::string_view word);
[[nodiscard]] std::vector<int> branches_in_system(const tree::VesselTree& tree, int system); // ascending

struct SystemFacts {
    int branches = 0, visible = 0;
    double length_mm = 0.0, volume_mm3 = 0.0;
};
[[nodiscard]] std::vector<SystemFacts> system_facts(const tree::VesselTree& tree, const TreeFacts& facts,
                                                    const Marks& marks);

// How a tree is coloured at first: several systems each in its own colour.
[[nodiscard]] ColourBy first_colouring(ColourBy wanted, const tree::VesselTree& tree);

} // namespace ramus::app
