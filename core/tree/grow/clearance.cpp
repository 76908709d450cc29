#include "core/tree/grow/clearance.h"

#include <algorithm>

namespace ramus::tree::growth {

namespace {

constexpr double kAir = 1.2;          // straight tubes keep this many times the sum of their radii apart
constexpr double kJointWay = 2.2;     // nearer along the tree than this many times the sum they may touch: a joint
constexpr double kInsideStep = 4.0;   // of the capsule's thickness: places at which a tube is tested
constexpr double kTooParallel = 0.82; // cosine between two segments that leave one joint

} // namespace

void Clearance::gather_kin(const Vec& fork, std::span<const Spoke> spokes, std::span<const int> own) {
    kin_.clear();
    double widest = 0.0;
    for (const Spoke& spoke : spokes) widest = std::max(widest, spoke.radius_mm);
    const double reach = kJointWay * 2.2 * widest;

    struct Stop {
        int node;
        int came_by;
        double way_mm;
    };
    std::vector<Stop> stack;
    for (const Spoke& spoke : spokes)
        if (spoke.node >= 0) stack.push_back({spoke.node, -1, glm::length(spoke.end - fork)});
    const auto is_own = [&](int segment) { return std::find(own.begin(), own.end(), segment) != own.end(); };
    while (!stack.empty()) {
        const Stop stop = stack.back();
        stack.pop_back();
        const Node& node = tree_.at(stop.node);
        const auto go = [&](int segment, bool from_parent_end) {
            if (segment <= 0 || segment == stop.came_by || is_own(segment)) return;
            kin_.push_back({segment, from_parent_end, stop.way_mm});
            const double beyond = stop.way_mm + tree_.length_mm(segment);
            if (beyond < reach)
                stack.push_back({from_parent_end ? segment : tree_.at(segment).parent, segment, beyond});
        };
        go(stop.node, false);
        for (int c = 0; c < node.child_count; ++c) go(node.children[static_cast<std::size_t>(c)], true);
    }
}

bool Clearance::inside(const Vec& a, const Vec& b, double radius_mm) const {
    const double length = glm::length(b - a);
    const int steps = 1 + static_cast<int>(length / (kInsideStep * organ_.capsule_mm()));
    for (int i = 0; i <= steps; ++i)
        if (organ_.depth_mm(a + (b - a) * (static_cast<double>(i) / steps)) < radius_mm + organ_.capsule_mm())
            return false;
    return true;
}

bool Clearance::fork_fits(const Vec& fork, std::span<const Spoke> spokes, std::span<const int> own) {
    for (const Spoke& spoke : spokes)
        if (!spoke.may_leave_organ && !inside(fork, spoke.end, spoke.radius_mm)) return false;
    gather_kin(fork, spokes, own);
    for (const Spoke& spoke : spokes) {
        grid_->query(fork, spoke.end, kAir * spoke.radius_mm, near_);
        for (const int other : near_) {
            if (std::find(own.begin(), own.end(), other) != own.end()) continue;
            const Vec& other_start = tree_.at(tree_.at(other).parent).position;
            const Approach near = closest_approach(fork, spoke.end, other_start, tree_.at(other).position);
            const double sum = spoke.radius_mm + tree_.radius_mm(other);
            if (near.distance >= kAir * sum) continue;
            const auto kin = std::find_if(kin_.begin(), kin_.end(), [&](const Kin& k) { return k.segment == other; });
            if (kin == kin_.end()) return false;
            if (tree_.at(other).parent == spoke.node || other == spoke.node) {
                // They meet at the far end of the spoke, where only their angle matters.
                const Vec ours = direction(spoke.end, fork);
                const Vec theirs = kin->from_parent_end ? tree_.way(other) : -tree_.way(other);
                if (glm::dot(ours, theirs) > kTooParallel) return false;
                continue;
            }
            const double along = kin->from_parent_end ? near.second : 1.0 - near.second;
            const double way =
                near.first * glm::length(spoke.end - fork) + kin->way_mm + along * tree_.length_mm(other);
            if (way > kJointWay * sum) return false;
        }
    }
    return true;
}

} // namespace ramus::tree::growth
