#include "core/tree/vessel_tree.h"

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

} // namespace ramus::tree
