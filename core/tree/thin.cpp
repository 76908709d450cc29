#include "core/tree/thin.h"

#include <glm/geometric.hpp>
#include <utility>

namespace ramus::tree {

VesselTree thinned(VesselTree tree, double spacing) {
    for (Branch& branch : tree.branches) {
        if (branch.points.size() < 3) continue;
        std::size_t kept = 1;
        for (std::size_t i = 1; i + 1 < branch.points.size(); ++i) {
            const Point& last = tree.points[branch.points[kept - 1]];
            const Point& point = tree.points[branch.points[i]];
            if (glm::distance(last.position, point.position) >= spacing * point.radius)
                branch.points[kept++] = branch.points[i];
        }
        branch.points[kept++] = branch.points.back();
        branch.points.resize(kept);
    }
    return tree;
}

} // namespace ramus::tree
