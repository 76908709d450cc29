// Moves marks to another tree, one function per kind of mark. Each changes its own members of `marks` and returns the
// number of marks that were lost. Called by carried_over() (carry_over.h).
#pragma once

#include "app/session/session.h"

#include <cstddef>

namespace ramus::app {

class BranchMap; // app/session/carry_over.h

std::size_t carry_selection(Marks& marks, const BranchMap& map);
std::size_t carry_states(Marks& marks, const BranchMap& map);
std::size_t carry_cuts(Marks& marks, const BranchMap& map);
std::size_t carry_plans(Marks& marks, const BranchMap& map); // cuts of the plans that wait
std::size_t carry_names(Marks& marks, const BranchMap& map); // also `subtree_names`
std::size_t carry_measurements(Marks& marks, const BranchMap& map);
std::size_t carry_systems(Marks& marks, const BranchMap& map);
std::size_t carry_colour_by(Marks& marks, const BranchMap& map);
std::size_t carry_organ(Marks& marks, const BranchMap& map); // roles of systems
std::size_t carry_planning(Marks& marks, const BranchMap& map);

} // namespace ramus::app
