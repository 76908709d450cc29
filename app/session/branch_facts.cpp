#include "app/session/branch_facts.h"

#include "app/session/usual_sizes.h"

#include <algorithm>

namespace ramus::app {

TreeFacts facts_of(const tree::VesselTree& tree) {
    TreeFacts facts;
    facts.dependency = tree::Dependency(tree);
    facts.statistics = measure::tree_statistics(tree);
    facts.dependents = measure::dependent_amounts(tree, facts.statistics, facts.dependency);
    for (std::size_t id = 0; id < tree.branches.size(); ++id)
        facts.branches.push_back({facts.statistics.branches[id], facts.dependents[id]});
    for (const int branch : parents_first(tree)) {
        const auto id = static_cast<std::size_t>(branch);
        const double end = facts.branches[id].root_distance_mm + facts.branches[id].length_mm;
        for (const int child : tree.branches[id].children)
            facts.branches[static_cast<std::size_t>(child)].root_distance_mm = end;
    }
    facts.usual_thin_mm = usual_sizes(tree).thin_mm;
    return facts;
}

bool nothing_depends(const TreeFacts& facts) {
    return facts.branches.size() > 1 && std::ranges::all_of(facts.branches, [](const BranchFacts& branch) {
               return branch.dependents.branches == 0;
           });
}

std::vector<int> parents_first(const tree::VesselTree& tree) {
    std::vector<int> order = branches_where(
        tree.branches.size(), [&](std::size_t id) { return tree.branches[id].parent == tree::kNoBranch; });
    for (std::size_t i = 0; i < order.size(); ++i) {
        const auto& children = tree.branches[static_cast<std::size_t>(order[i])].children;
        order.insert(order.end(), children.begin(), children.end());
    }
    return order;
}

std::vector<int> path_to(const tree::VesselTree& tree, int branch) {
    std::vector<int> path;
    for (int id = branch; id != tree::kNoBranch; id = tree.branches[static_cast<std::size_t>(id)].parent)
        path.push_back(id);
    std::reverse(path.begin(), path.end());
    return path;
}

} // namespace ramus::app
