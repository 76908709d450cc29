#include "core/tree/network.h"

namespace ramus::tree {

Network::Network(const VesselTree& tree) : ends(tree.branches.size()) {
    std::vector<int> node_of(tree.points.size(), -1);
    const auto node_at = [&](std::uint32_t point) {
        int& node = node_of[point];
        if (node < 0) {
            node = static_cast<int>(points.size());
            points.push_back(point);
        }
        return node;
    };
    for (std::size_t b = 0; b < ends.size(); ++b)
        ends[b] = {node_at(tree.branches[b].points.front()), node_at(tree.branches[b].points.back())};

    first.assign(points.size() + 1, 0);
    for (const auto& [start, end] : ends) {
        ++first[static_cast<std::size_t>(start) + 1];
        ++first[static_cast<std::size_t>(end) + 1];
    }
    for (std::size_t n = 0; n < points.size(); ++n) first[n + 1] += first[n];
    around.resize(2 * ends.size());
    std::vector<int> next(first.begin(), first.end() - 1);
    std::vector<char> rooted(points.size(), 0);
    for (std::size_t b = 0; b < ends.size(); ++b) {
        for (const int node : ends[b])
            around[static_cast<std::size_t>(next[static_cast<std::size_t>(node)]++)] = static_cast<int>(b);
        if (tree.branches[b].parent != kNoBranch) continue;
        char& known = rooted[static_cast<std::size_t>(ends[b][0])];
        if (known == 0) roots.push_back(ends[b][0]);
        known = 1;
    }
}

} // namespace ramus::tree
