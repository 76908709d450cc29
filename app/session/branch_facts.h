// What a person wants to know of a branch, computed once for a whole tree: tooltips, panels, commands and colours look
// it up. "Depends" is core/tree/dependency.h's: reached only through the branch, right in networks with loops too.
#pragma once

#include "core/measure/amount.h"
#include "core/measure/tree_measure.h"
#include "core/tree/dependency.h"

#include <vector>

namespace ramus::app {

struct BranchFacts {
    double length_mm = 0.0;
    double mean_diameter_mm = 0.0; // along the centerline
    double min_diameter_mm = 0.0;
    double max_diameter_mm = 0.0;
    double volume_mm3 = 0.0;          // of the cones between the points
    double root_distance_mm = 0.0;    // along the vessels, from the root to where the branch begins
    int dependents = 0;               // branches that are reached only through this one
    double dependent_length_mm = 0.0; // of those, without this one
    double dependent_volume_mm3 = 0.0;
    int dependent_leaves = 0; // of those, the ones that end freely
};

struct TreeFacts {
    std::vector<BranchFacts> branches; // by id
    double length_mm = 0.0;
    double volume_mm3 = 0.0; // of the cones between the points
    double min_diameter_mm = 0.0;
    double max_diameter_mm = 0.0;
    int generations = 0;
    int leaves = 0;

    tree::Dependency dependency;
    measure::TreeStatistics statistics;
    std::vector<measure::Amount> dependents; // by id: what depends on it, without itself
};

[[nodiscard]] TreeFacts facts_of(const tree::VesselTree& tree);

// From the root to `branch`, both included.
[[nodiscard]] std::vector<int> path_to(const tree::VesselTree& tree, int branch);

} // namespace ramus::app
