#include "core/mesh/loops/tree_cycles.h"

#include "core/base/disjoint_sets.h"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <glm/geometric.hpp>
#include <numeric>
#include <queue>
#include <span>
#include <unordered_map>
#include <utility>

namespace ramus::mesh {

namespace {

constexpr std::size_t kMostVisited = 4096; // nodes visited for one cycle

class BranchGraph {
public:
    explicit BranchGraph(const tree::VesselTree& tree) : tree_(tree), ways_(tree.points.size()) {}

    void add(std::uint32_t branch, double length) {
        const auto& points = tree_.branches[branch].points;
        ways_[points.front()].push_back({points.back(), branch, length});
        ways_[points.back()].push_back({points.front(), branch, length});
    }
    // The branches of the shortest way, from `to` back to `from`; none if the search exceeds kMostVisited.
    [[nodiscard]] std::vector<std::uint32_t> way(std::uint32_t from, std::uint32_t to) const {
        struct ReachedNode {
            double distance;
            std::uint32_t before, branch;
        };
        std::unordered_map<std::uint32_t, ReachedNode> reached{{from, {0.0, from, 0}}};
        using Open = std::pair<double, std::uint32_t>;
        std::priority_queue<Open, std::vector<Open>, std::greater<>> open;
        open.emplace(0.0, from);
        while (!open.empty() && open.top().second != to && reached.size() < kMostVisited) {
            const auto [distance, node] = open.top();
            open.pop();
            if (distance > reached[node].distance) continue;
            for (const Way& next : ways_[node]) {
                const double there = distance + next.length;
                const auto [known, fresh] = reached.try_emplace(next.to, ReachedNode{there, node, next.branch});
                if (!fresh && known->second.distance <= there) continue;
                known->second = {there, node, next.branch};
                open.emplace(there, next.to);
            }
        }
        std::vector<std::uint32_t> branches;
        if (open.empty() || open.top().second != to) return branches;
        for (std::uint32_t node = to; node != from; node = reached[node].before)
            branches.push_back(reached[node].branch);
        return branches;
    }

private:
    struct Way {
        std::uint32_t to, branch;
        double length;
    };
    const tree::VesselTree& tree_;
    std::vector<std::vector<Way>> ways_; // by point
};

double length_of(const tree::VesselTree& tree, const tree::Branch& branch) {
    double length = 0.0;
    for (std::size_t i = 1; i < branch.points.size(); ++i)
        length += glm::distance(tree.points[branch.points[i - 1]].position, tree.points[branch.points[i]].position);
    return length;
}

// The points along consecutive branches; each branch begins where the previous one ends.
std::vector<tree::Point> along(const tree::VesselTree& tree, std::uint32_t from,
                               std::span<const std::uint32_t> branches) {
    std::vector<tree::Point> line;
    std::uint32_t at = from;
    for (const std::uint32_t branch : branches) {
        auto points = tree.branches[branch].points;
        if (points.front() != at) std::ranges::reverse(points);
        for (std::size_t i = 0; i + 1 < points.size(); ++i) line.push_back(tree.points[points[i]]);
        at = points.back();
    }
    return line;
}

} // namespace

std::vector<std::vector<tree::Point>> short_cycles(const tree::VesselTree& tree) {
    std::vector<double> length;
    for (const tree::Branch& branch : tree.branches) length.push_back(length_of(tree, branch));
    std::vector<std::uint32_t> order(length.size());
    std::iota(order.begin(), order.end(), 0U);
    std::ranges::stable_sort(order, {}, [&](std::uint32_t branch) { return length[branch]; });
    DisjointSets joined(tree.points.size());
    BranchGraph graph(tree);
    std::vector<std::uint32_t> others; // branches that close a cycle
    for (const std::uint32_t branch : order) {
        const auto& points = tree.branches[branch].points;
        if (points.size() < 2) continue;
        if (joined.find(points.front()) == joined.find(points.back())) {
            others.push_back(branch);
            continue;
        }
        joined.join(points.front(), points.back());
        graph.add(branch, length[branch]);
    }
    std::vector<std::vector<tree::Point>> cycles;
    for (const std::uint32_t branch : others) {
        const auto& points = tree.branches[branch].points;
        std::vector<std::uint32_t> branches;
        if (points.front() != points.back()) branches = graph.way(points.back(), points.front());
        const bool closed = points.front() == points.back() || !branches.empty();
        branches.push_back(branch);
        std::ranges::reverse(branches); // the branch itself, then the way back from its end
        if (closed) cycles.push_back(along(tree, points.front(), branches));
        graph.add(branch, length[branch]);
    }
    return cycles;
}

} // namespace ramus::mesh
