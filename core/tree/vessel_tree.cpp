#include "core/tree/vessel_tree.h"

#include <algorithm>
#include <glm/geometric.hpp>

namespace ramus::tree {

std::size_t VesselTree::segment_count() const {
    std::size_t count = 0;
    for (const Branch& branch : branches) count += branch.points.size() - 1;
    return count;
}

double length_mm(const VesselTree& tree, const Branch& branch) {
    double sum = 0.0;
    for (std::size_t i = 1; i < branch.points.size(); ++i)
        sum += glm::distance(tree.points[branch.points[i - 1]].position, tree.points[branch.points[i]].position);
    return sum;
}

std::vector<int> subtree(const VesselTree& tree, int branch) {
    std::vector<int> members{branch};
    for (std::size_t i = 0; i < members.size(); ++i) {
        const auto& children = tree.branches[static_cast<std::size_t>(members[i])].children;
        members.insert(members.end(), children.begin(), children.end());
    }
    std::ranges::sort(members);
    return members;
}

} // namespace ramus::tree
