#include "core/measure/amount.h"

namespace ramus::measure {

std::vector<char> free_ends(const tree::VesselTree& tree) {
    std::vector<unsigned char> joined(tree.points.size(), 0);
    const auto join = [&](std::uint32_t point) {
        if (joined[point] < 2) ++joined[point];
    };
    for (const tree::Branch& branch : tree.branches) {
        join(branch.points.front());
        join(branch.points.back());
    }
    std::vector<char> free;
    free.reserve(tree.branches.size());
    for (const tree::Branch& branch : tree.branches) free.push_back(joined[branch.points.back()] == 1 ? 1 : 0);
    return free;
}

std::vector<Amount> dependent_amounts(const tree::VesselTree& tree, const TreeStatistics& statistics,
                                      const tree::Dependency& dependency) {
    const std::vector<char> free = free_ends(tree);
    std::vector<Amount> amounts(tree.branches.size());
    const auto order = dependency.order();
    for (std::size_t i = order.size(); i-- > 0;) { // dependents first
        const int above = dependency.parent(order[i]);
        if (above == tree::kNoBranch) continue;
        const auto b = static_cast<std::size_t>(order[i]);
        Amount& sum = amounts[static_cast<std::size_t>(above)];
        sum += amounts[b];
        sum += {1, statistics.branches[b].length_mm, statistics.branches[b].volume_mm3, free[b]};
    }
    return amounts;
}

} // namespace ramus::measure
