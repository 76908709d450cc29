#include "core/tree/dependency.h"

#include "core/base/grouped.h"

#include <algorithm>
#include <utility>

namespace ramus::tree {

namespace {

// Parents before their children; children in ascending order.
std::vector<int> from_the_roots(const VesselTree& tree) {
    const std::size_t count = tree.branches.size();
    std::vector<int> order;
    order.reserve(count);
    for (std::size_t b = 0; b < count; ++b)
        if (tree.branches[b].parent == kNoBranch) order.push_back(static_cast<int>(b));
    const Grouped<int> children(count, [&](const auto& put) {
        for (std::size_t b = 0; b < count; ++b)
            if (const int parent = tree.branches[b].parent; parent != kNoBranch)
                put(static_cast<std::size_t>(parent), static_cast<int>(b));
    });
    for (std::size_t i = 0; i < order.size(); ++i) {
        const auto next = children.of(static_cast<std::size_t>(order[i]));
        order.insert(order.end(), next.begin(), next.end());
    }
    return order;
}

} // namespace

Dependency::Dependency(const VesselTree& tree)
    : bridge_(tree.branches.size(), 1), parent_(tree.branches.size(), kNoBranch), place_(tree.branches.size(), 0),
      size_(tree.branches.size(), 1) {
    const std::vector<int> outward = from_the_roots(tree);
    find_bridges(tree, outward);
    for (const int b : outward) {
        const int above = tree.branches[index(b)].parent;
        if (above != kNoBranch) parent_[index(b)] = is_bridge(above) ? above : parent_[index(above)];
    }
    number(outward);
}

// A branch that closes a loop forms a ring with the way through the hierarchy between its ends. No branch of a ring is
// a bridge. Branches of earlier rings are skipped, so that every branch is visited once.
void Dependency::find_bridges(const VesselTree& tree, std::span<const int> outward) {
    std::vector<int> depth(tree.branches.size(), 0);
    // The branch through which the hierarchy reaches a point; -2: none yet. Roots are reached through no branch.
    constexpr int kUnreached = -2;
    std::vector<int> reached(tree.points.size(), kUnreached);
    for (const int b : outward) {
        const Branch& branch = tree.branches[index(b)];
        if (branch.parent == kNoBranch)
            reached[branch.points.front()] = kNoBranch;
        else
            depth[index(b)] = depth[index(branch.parent)] + 1;
    }
    std::vector<int> closing;
    // In the order of ids: where two branches end at one point, the first one is that of the hierarchy.
    for (std::size_t b = 0; b < tree.branches.size(); ++b) {
        int& through = reached[tree.branches[b].points.back()];
        if (through == kUnreached)
            through = static_cast<int>(b);
        else
            closing.push_back(static_cast<int>(b));
    }
    // The nearest branch at or above `branch` that is still a bridge, with path compression.
    std::vector<int> above(tree.branches.size());
    for (std::size_t b = 0; b < above.size(); ++b) above[b] = static_cast<int>(b);
    const auto nearest_bridge = [&](int b) {
        int top = b;
        while (top != kNoBranch && above[index(top)] != top) top = above[index(top)];
        while (b != top) b = std::exchange(above[index(b)], top);
        return top;
    };
    for (const int b : closing) {
        bridge_[index(b)] = 0;
        int x = nearest_bridge(tree.branches[index(b)].parent);
        int y = nearest_bridge(reached[tree.branches[index(b)].points.back()]);
        while (x != y) {
            if (x == kNoBranch || (y != kNoBranch && depth[index(y)] > depth[index(x)])) std::swap(x, y);
            bridge_[index(x)] = 0;
            above[index(x)] = tree.branches[index(x)].parent;
            x = nearest_bridge(x);
        }
    }
}

void Dependency::number(std::span<const int> outward) {
    for (std::size_t i = outward.size(); i-- > 0;) {
        const int b = outward[i];
        if (parent(b) != kNoBranch) size_[index(parent(b))] += size_[index(b)];
    }
    order_.resize(outward.size());
    int free = 0;                             // where the next branch that depends on nothing goes
    std::vector<int> next_in(outward.size()); // where a branch's next dependent goes
    for (const int b : outward) {
        int& next = parent(b) == kNoBranch ? free : next_in[index(parent(b))];
        place_[index(b)] = next;
        order_[index(next)] = b;
        next_in[index(b)] = next + 1;
        next += size_[index(b)];
    }
}

std::vector<int> Dependency::upstream(int branch) const {
    std::vector<int> all;
    for (int b = parent(branch); b != kNoBranch; b = parent(b)) all.push_back(b);
    return all;
}

std::vector<int> Dependency::with_dependents(std::span<const int> branches) const {
    std::vector<int> positions;
    positions.reserve(branches.size());
    for (const int b : branches) positions.push_back(place_[index(b)]);
    std::ranges::sort(positions);
    std::vector<int> all;
    int covered = 0; // of the order, so far: intervals nest or are apart
    for (const int position : positions) {
        if (position < covered) continue;
        const auto part = with_dependents(order_[index(position)]);
        all.insert(all.end(), part.begin(), part.end());
        covered = position + static_cast<int>(part.size());
    }
    std::ranges::sort(all);
    return all;
}

std::vector<int> subtree(const VesselTree& tree, int branch) {
    const Dependency dependency(tree);
    const auto part = dependency.with_dependents(branch);
    std::vector<int> members(part.begin(), part.end());
    std::ranges::sort(members);
    return members;
}

} // namespace ramus::tree
