#include "core/tree/grow/reshape.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace ramus::tree::growth {

bool merge_one_fork(Skeleton& tree, Clearance& clearance) {
    std::vector<std::pair<double, int>> inner;
    for (int id = kHilum + 1; id < tree.size(); ++id)
        if (tree.at(id).child_count > 0) inner.emplace_back(tree.length_mm(id) / tree.radius_mm(id), id);
    std::sort(inner.begin(), inner.end());
    for (const auto& [slenderness, id] : inner) {
        const int above = tree.at(id).parent;
        std::vector<Spoke> spokes{
            {tree.at(above).parent, tree.at(tree.at(above).parent).position, tree.radius_mm(above), above == kHilum}};
        std::vector<int> own{above, id};
        const auto add = [&](int child) {
            spokes.push_back({child, tree.at(child).position, tree.radius_mm(child)});
            own.push_back(child);
        };
        for (const int parent : {above, id})
            for (int c = 0; c < 2; ++c)
                if (const int child = tree.at(parent).children[static_cast<std::size_t>(c)]; child != id) add(child);
        const Vec& fork = tree.at(above).position;
        const bool narrow = [&] {
            for (std::size_t i = 1; i < spokes.size(); ++i)
                for (std::size_t k = 1; k < i; ++k)
                    if (glm::dot(direction(fork, spokes[i].end), direction(fork, spokes[k].end)) > kNarrowFork)
                        return true;
            return false;
        }();
        if (narrow || !clearance.fork_fits(fork, spokes, own)) continue;

        Node& keeper = tree.at(above);
        keeper.child_count = 3;
        for (std::size_t i = 0; i < 3; ++i) {
            keeper.children[i] = spokes[i + 1].node;
            tree.at(keeper.children[i]).parent = above;
        }
        // The last node takes the index of the removed one.
        const int last = tree.size() - 1;
        if (id != last) {
            const Node moved = tree.at(last);
            tree.at(id) = moved;
            auto& siblings = tree.at(moved.parent).children;
            *std::find(siblings.begin(), siblings.end(), last) = id;
            for (int c = 0; c < moved.child_count; ++c)
                tree.at(moved.children[static_cast<std::size_t>(c)]).parent = id;
        }
        tree.nodes.pop_back();
        return true;
    }
    return false;
}

Skeleton without_segments(const Skeleton& tree, std::span<const int> segments) {
    std::vector<bool> gone(tree.nodes.size(), false);
    for (const int id : segments) gone[static_cast<std::size_t>(id)] = tree.at(id).parent > kHilum;
    const std::vector<int> order = tree.from_root();
    for (const int id : order)
        if (id > kHilum && gone[static_cast<std::size_t>(tree.at(id).parent)])
            gone[static_cast<std::size_t>(id)] = true;

    // A fork with only one remaining child becomes an inner point: the child is connected to the fork's parent.
    Skeleton kept;
    kept.root_radius_mm = tree.root_radius_mm;
    std::vector<int> new_id(tree.nodes.size(), -1);
    for (const int id : order) {
        if (gone[static_cast<std::size_t>(id)]) continue;
        const Node& node = tree.at(id);
        int left = 0;
        for (int c = 0; c < node.child_count; ++c)
            left += gone[static_cast<std::size_t>(node.children[static_cast<std::size_t>(c)])] ? 0 : 1;
        const int above = node.parent < 0 ? -1 : new_id[static_cast<std::size_t>(node.parent)];
        const bool inner_point = id > kHilum && left == 1 && node.child_count > 1;
        new_id[static_cast<std::size_t>(id)] = inner_point ? above : kept.add(node.position, above, node.flow);
    }
    kept.settle_flows();
    return kept;
}

} // namespace ramus::tree::growth
