#include "core/tree/build_tree.h"

#include <algorithm>

namespace ramus::tree {

namespace {

using Edges = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

// Edges at each point, as one array.
struct Incidence {
    std::vector<std::uint32_t> first; // per point, and one past the last
    std::vector<std::uint32_t> edge;

    Incidence(std::size_t points, const Edges& edges) : first(points + 1, 0), edge(2 * edges.size()) {
        for (const auto& [a, b] : edges) ++first[a + 1], ++first[b + 1];
        for (std::size_t p = 0; p < points; ++p) first[p + 1] += first[p];
        std::vector<std::uint32_t> next(first.begin(), first.end() - 1);
        for (std::uint32_t e = 0; e < edges.size(); ++e) {
            edge[next[edges[e].first]++] = e;
            edge[next[edges[e].second]++] = e;
        }
    }
    [[nodiscard]] std::uint32_t degree(std::uint32_t p) const { return first[p + 1] - first[p]; }
};

class Assembler {
public:
    Assembler(VesselTree& tree, const Edges& edges)
        : tree_(tree), edges_(edges), incidence_(tree.points.size(), edges), used_(edges.size(), false),
          reached_(tree.points.size(), false) {}

    // Walks one component from its root, breadth first over branches, so that a branch's parent has a lower id.
    void grow_from(std::uint32_t root) {
        if (reached_[root] || incidence_.degree(root) == 0) return;
        // Nor is it one where a branch of another root runs through it.
        const auto first = incidence_.edge.begin() + incidence_.first[root];
        if (std::all_of(first, first + incidence_.degree(root), [&](std::uint32_t edge) { return bool(used_[edge]); }))
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
            for (std::uint32_t i = incidence_.first[node.point]; i < incidence_.first[node.point + 1]; ++i) {
                if (used_[incidence_.edge[i]]) continue;
                const int id = static_cast<int>(tree_.branches.size());
                const std::uint32_t end = walk(node.point, incidence_.edge[i], node.parent);
                if (reached_[end]) continue; // closes a loop: nothing depends on it
                reached_[end] = true;
                open.push_back({end, id});
            }
        }
    }

private:
    // Follows points of degree 2 from `from` along `edge`; returns the point where the branch ends. A root is a node
    // whatever its degree: what hangs on either side of it depends on it separately.
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
            if (incidence_.degree(at) != 2 || at == from || reached_[at]) break;
            const std::uint32_t* around = incidence_.edge.data() + incidence_.first[at];
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
    Incidence incidence_;
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
                    const std::vector<std::uint32_t>& roots) {
    VesselTree tree;
    tree.points = std::move(points);
    tree.labels = std::move(labels);
    Assembler assembler(tree, edges);
    for (const std::uint32_t root : roots) assembler.grow_from(root);
    set_strahler(tree);
    tree.loop_count =
        static_cast<int>(edges.size()) - static_cast<int>(tree.points.size()) + static_cast<int>(tree.roots.size());
    return tree;
}

} // namespace ramus::tree
