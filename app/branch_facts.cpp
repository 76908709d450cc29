#include "app/branch_facts.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

namespace ramus::app {

TreeFacts facts_of(const tree::VesselTree& tree) {
    TreeFacts facts;
    facts.branches.resize(tree.branches.size());
    facts.min_diameter_mm = tree.branches.empty() ? 0.0 : std::numeric_limits<double>::max();
    std::vector<int> order; // parents before children
    for (std::size_t id = 0; id < tree.branches.size(); ++id) {
        const tree::Branch& branch = tree.branches[id];
        BranchFacts& own = facts.branches[id];
        if (branch.parent == tree::kNoBranch) order.push_back(static_cast<int>(id));
        own.min_diameter_mm = std::numeric_limits<double>::max();
        double weighted = 0.0;
        for (std::size_t i = 0; i < branch.points.size(); ++i) {
            const tree::Point& point = tree.points[branch.points[i]];
            own.min_diameter_mm = std::min(own.min_diameter_mm, 2.0 * point.radius);
            own.max_diameter_mm = std::max(own.max_diameter_mm, 2.0 * point.radius);
            if (i == 0) continue;
            const tree::Point& before = tree.points[branch.points[i - 1]];
            const double step = glm::distance(before.position, point.position);
            const double r0 = before.radius;
            const double r1 = point.radius;
            own.length_mm += step;
            weighted += step * (r0 + r1);
            own.volume_mm3 += std::numbers::pi / 3.0 * step * (r0 * r0 + r0 * r1 + r1 * r1);
        }
        facts.volume_mm3 += own.volume_mm3;
        own.mean_diameter_mm = own.length_mm > 0.0 ? weighted / own.length_mm : own.max_diameter_mm;
        facts.length_mm += own.length_mm;
        facts.min_diameter_mm = std::min(facts.min_diameter_mm, own.min_diameter_mm);
        facts.max_diameter_mm = std::max(facts.max_diameter_mm, own.max_diameter_mm);
        facts.generations = std::max(facts.generations, branch.generation + 1);
        facts.leaves += branch.children.empty() ? 1 : 0;
    }
    for (std::size_t i = 0; i < order.size(); ++i) {
        const auto id = static_cast<std::size_t>(order[i]);
        const auto& children = tree.branches[id].children;
        const double end = facts.branches[id].root_distance_mm + facts.branches[id].length_mm;
        for (const int child : children) facts.branches[static_cast<std::size_t>(child)].root_distance_mm = end;
        order.insert(order.end(), children.begin(), children.end());
    }
    for (std::size_t i = order.size(); i-- > 0;) {
        const auto id = static_cast<std::size_t>(order[i]);
        const int parent = tree.branches[id].parent;
        if (parent == tree::kNoBranch) continue;
        const BranchFacts& own = facts.branches[id];
        BranchFacts& above = facts.branches[static_cast<std::size_t>(parent)];
        above.dependents += own.dependents + 1;
        above.dependent_length_mm += own.dependent_length_mm + own.length_mm;
        above.dependent_volume_mm3 += own.dependent_volume_mm3 + own.volume_mm3;
    }
    return facts;
}

std::vector<int> path_to(const tree::VesselTree& tree, int branch) {
    std::vector<int> path;
    for (int id = branch; id != tree::kNoBranch; id = tree.branches[static_cast<std::size_t>(id)].parent)
        path.push_back(id);
    std::reverse(path.begin(), path.end());
    return path;
}

} // namespace ramus::app
