#include "core/base/grouped.h"
#include "core/tree/build_tree.h"

#include <algorithm>

namespace ramus::tree {

namespace {

using Edges = std::vector<Edge>;

class Assembler {
public:
    Assembler(VesselTree& tree, const Edges& edges)
        : tree_(tree), edges_(edges), at_(tree.points.size(),
                                          [&](const auto& put) {
                                              for (std::uint32_t e = 0; e < edges.size(); ++e)
                                                  put(edges[e].first, e), put(edges[e].second, e);
                                          }),
          used_(edges.size(), false), reached_(tree.points.size(), false) {}

    // Walks one component from its root, breadth first over branches, so that a branch's parent has a lower id.
    void grow_from(std::uint32_t root) {
        // A point without edges is no root, nor is one that a branch of another root has reached.
        if (reached_[root] || std::ranges::all_of(at_.of(root), [&](std::uint32_t edge) { return bool(used_[edge]); }))
            return;
        tree_.roots.push_back(root);
        reached_[root] = true;
        struct Node {
            std::uint32_t point;
            int parent;
        };
        std::vector<Node> open{{root, kNoBranch}};
        for (std::size_t n = 0; n < open.size(); ++n) {
            const Node node = open[n];
            for (const std::uint32_t edge : at_.of(node.point)) {
                if (used_[edge]) continue;
                const int id = static_cast<int>(tree_.branches.size());
                const std::uint32_t end = walk(node.point, edge, node.parent);
                if (reached_[end]) continue; // closes a loop: nothing depends on it
                reached_[end] = true;
                open.push_back({end, id});
            }
        }
    }

private:
    // Follows points of degree 2 from `from` along `edge`; returns the point where the branch ends. A root is always a
    // node, since each of its sides is a branch of its own.
    std::uint32_t walk(std::uint32_t from, std::uint32_t edge, int parent) {
        Branch branch;
        branch.parent = parent;
        if (parent != kNoBranch) branch.generation = tree_.branches[static_cast<std::size_t>(parent)].generation + 1;
        branch.points.push_back(from);
        std::uint32_t at = from;
        while (true) {
            used_[edge] = true;
            at = edges_[edge].first == at ? edges_[edge].second : edges_[edge].first;
            branch.points.push_back(at);
            const auto around = at_.of(at);
            if (around.size() != 2 || at == from || reached_[at]) break;
            const std::uint32_t next = around[0] == edge ? around[1] : around[0];
            if (used_[next]) break;
            edge = next;
        }
        const int id = static_cast<int>(tree_.branches.size());
        if (parent != kNoBranch) tree_.branches[static_cast<std::size_t>(parent)].children.push_back(id);
        tree_.branches.push_back(std::move(branch));
        return at;
    }

    VesselTree& tree_;
    const Edges& edges_;
    Grouped<std::uint32_t> at_; // edges at each point
    std::vector<bool> used_;
    std::vector<bool> reached_;
};

// Children have higher ids than their parents, so one sweep from the end sees them first.
void set_strahler(VesselTree& tree) {
    for (std::size_t id = tree.branches.size(); id-- > 0;) {
        Branch& branch = tree.branches[id];
        int highest = 0;
        int times = 0;
        for (const int child : branch.children) {
            const int order = tree.branches[static_cast<std::size_t>(child)].strahler;
            if (order > highest) highest = order, times = 0;
            if (order == highest) ++times;
        }
        branch.strahler = highest == 0 ? 1 : highest + (times > 1 ? 1 : 0);
    }
}

} // namespace

VesselTree assemble(std::vector<Point> points, std::vector<int> labels, const Edges& edges,
                    const std::vector<std::uint32_t>& roots, const std::vector<int>& point_systems) {
    VesselTree tree;
    tree.points = std::move(points);
    tree.labels = std::move(labels);
    Assembler assembler(tree, edges);
    for (const std::uint32_t root : roots) assembler.grow_from(root);
    set_strahler(tree);
    if (!point_systems.empty())
        for (Branch& branch : tree.branches) branch.system = point_systems[branch.points.front()];
    tree.loop_count =
        static_cast<int>(edges.size()) - static_cast<int>(tree.points.size()) + static_cast<int>(tree.roots.size());
    return tree;
}

} // namespace ramus::tree
