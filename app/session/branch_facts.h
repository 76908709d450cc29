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
    double usual_thin_mm = 0.0;              // UsualSizes::thin_mm
};

[[nodiscard]] TreeFacts facts_of(const tree::VesselTree& tree);

// Whether there are several branches and none depends on another: separate vessels, each with a root of its own.
// Nothing can be said then of what a cut would cost beyond the vessel itself.
[[nodiscard]] bool nothing_depends(const TreeFacts& facts);
inline constexpr const char* kNothingDepends = "not known: separate vessels";

// Every branch, behind the one that it comes from.
[[nodiscard]] std::vector<int> parents_first(const tree::VesselTree& tree);

// Of so many branches those that are so, ascending.
template <class Is> [[nodiscard]] std::vector<int> branches_where(std::size_t count, const Is& is) {
    std::vector<int> ids;
    for (std::size_t id = 0; id < count; ++id)
        if (is(id)) ids.push_back(static_cast<int>(id));
    return ids;
}

// From the root to `branch`, both included.
[[nodiscard]] std::vector<int> path_to(const tree::VesselTree& tree, int branch);

} // namespace ramus::app
