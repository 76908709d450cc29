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

    around = Grouped<int>(points.size(), [&](const auto& put) {
        for (std::size_t b = 0; b < ends.size(); ++b)
            for (const int node : ends[b]) put(static_cast<std::size_t>(node), static_cast<int>(b));
    });
    std::vector<char> rooted(points.size(), 0);
    for (std::size_t b = 0; b < ends.size(); ++b) {
        if (tree.branches[b].parent != kNoBranch) continue;
        char& known = rooted[static_cast<std::size_t>(ends[b][0])];
        if (known == 0) roots.push_back(ends[b][0]);
        known = 1;
    }
}

} // namespace ramus::tree
