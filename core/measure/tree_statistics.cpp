#include "core/measure/tree_statistics.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

namespace ramus::measure {

TreeStatistics tree_statistics(const tree::VesselTree& tree) {
    TreeStatistics all;
    all.branches.reserve(tree.branches.size());
    double radius_times_length = 0.0;
    double least = std::numeric_limits<double>::max();
    for (const tree::Branch& branch : tree.branches) {
        BranchStatistics one;
        one.diameter_mm.min = std::numeric_limits<double>::max();
        double diameter_times_length = 0.0;
        for (std::size_t i = 0; i < branch.points.size(); ++i) {
            const tree::Point& end = tree.points[branch.points[i]];
            one.diameter_mm.min = std::min(one.diameter_mm.min, 2.0 * end.radius);
            one.diameter_mm.max = std::max(one.diameter_mm.max, 2.0 * end.radius);
            if (i == 0) continue;
            const tree::Point& start = tree.points[branch.points[i - 1]];
            const double length = glm::distance(start.position, end.position);
            one.length_mm += length;
            diameter_times_length += length * (start.radius + end.radius);
            one.volume_mm3 += std::numbers::pi / 3.0 * length *
                              (start.radius * start.radius + start.radius * end.radius + end.radius * end.radius);
        }
        one.diameter_mm.mean = diameter_times_length / one.length_mm; // positive: a branch has a length
        all.length_mm += one.length_mm;
        all.volume_mm3 += one.volume_mm3;
        radius_times_length += diameter_times_length / 2.0;
        least = std::min(least, one.diameter_mm.min / 2.0);
        all.radius_mm.max = std::max(all.radius_mm.max, one.diameter_mm.max / 2.0);
        all.generations = std::max(all.generations, branch.generation + 1);
        all.highest_strahler = std::max(all.highest_strahler, branch.strahler);
        if (branch.children.empty()) ++all.leaves;
        all.branches.push_back(one);
    }
    if (!tree.branches.empty()) {
        all.radius_mm.min = least;
        all.radius_mm.mean = radius_times_length / all.length_mm;
    }
    return all;
}

} // namespace ramus::measure
