// What becomes of each kind of mark on branches when the tree is another one. Each function changes its own members of
// `marks` and returns how many marks were lost.
#pragma once

#include "app/session/session.h"

#include <cstddef>

namespace ramus::app {

class BranchMap; // app/session/carry_over.h

std::size_t carry_selection(Marks& marks, const BranchMap& map);
std::size_t carry_states(Marks& marks, const BranchMap& map);
std::size_t carry_cuts(Marks& marks, const BranchMap& map);
std::size_t carry_names(Marks& marks, const BranchMap& map); // with `subtree_names`
std::size_t carry_measurements(Marks& marks, const BranchMap& map);
std::size_t carry_systems(Marks& marks, const BranchMap& map);
std::size_t carry_colour_by(Marks& marks, const BranchMap& map);
std::size_t carry_planning(Marks& marks, const BranchMap& map);

} // namespace ramus::app
