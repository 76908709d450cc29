// Facts about each branch, computed once per tree and looked up by tooltips, panels, commands and colours. "Dependents"
// as in core/tree/dependency.h: branches that are reached only through the branch; correct for networks with loops,
// too.
#pragma once

#include "core/measure/amount.h"
#include "core/measure/tree_measure.h"
#include "core/tree/dependency.h"

#include <vector>

namespace ramus::app {

struct BranchFacts : measure::BranchStatistics {
    measure::Amount dependents;    // the branch itself excluded
    double root_distance_mm = 0.0; // along the vessels, from the root to the start of the branch
};

struct TreeFacts {
    std::vector<BranchFacts> branches; // by id
    tree::Dependency dependency;
    measure::TreeStatistics statistics;
    std::vector<measure::Amount> dependents; // by id; equal to branches[id].dependents
    double usual_thin_mm = 0.0;              // UsualSizes::thin_mm
};

[[nodiscard]] TreeFacts facts_of(const tree::VesselTree& tree);

// Whether the tree consists of several separate vessels, each with its own root. The effect of a cut beyond the vessel
// itself is then unknown.
[[nodiscard]] bool nothing_depends(const TreeFacts& facts);
inline constexpr const char* kNothingDepends = "not known: separate vessels";

// All branches in topological order: parents before children.
[[nodiscard]] std::vector<int> parents_first(const tree::VesselTree& tree);

// The ids below `count` for which `is` holds, ascending.
template <class Is> [[nodiscard]] std::vector<int> branches_where(std::size_t count, const Is& is) {
    std::vector<int> ids;
    for (std::size_t id = 0; id < count; ++id)
        if (is(id)) ids.push_back(static_cast<int>(id));
    return ids;
}

// The branches from the root to `branch`, both included.
[[nodiscard]] std::vector<int> path_to(const tree::VesselTree& tree, int branch);

} // namespace ramus::app
