// What a person wants to know of a branch, computed once for a whole tree: tooltips, panels, commands and colours look
// it up. "Depends" is core/tree/dependency.h's: reached only through the branch, right in networks with loops too.
#pragma once

#include "core/measure/amount.h"
#include "core/measure/tree_measure.h"
#include "core/tree/dependency.h"

#include <vector>

namespace ramus::app {

struct BranchFacts : measure::BranchStatistics {
    measure::Amount dependents;    // branches that are reached only through this one, without itself
    double root_distance_mm = 0.0; // along the vessels, from the root to where the branch begins
};

struct TreeFacts {
    std::vector<BranchFacts> branches; // by id
    tree::Dependency dependency;
    measure::TreeStatistics statistics;
    std::vector<measure::Amount> dependents; // by id, as in the branches' facts
};

[[nodiscard]] TreeFacts facts_of(const tree::VesselTree& tree);

// From the root to `branch`, both included.
[[nodiscard]] std::vector<int> path_to(const tree::VesselTree& tree, int branch);

} // namespace ramus::app
