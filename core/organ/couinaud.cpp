#include "core/organ/couinaud.h"

#include <algorithm>
#include <glm/vec3.hpp>
#include <tuple>

namespace ramus::organ {

namespace {

constexpr double kLeastSide = 0.15;   // of the tips: what a fork of left and right has on its smaller side
constexpr double kMostOfHalf = 0.4;   // of a half's tips: a part with more is divided
constexpr double kLeastOfHalf = 0.04; // a part with less is not named

// The tips of each branch and its dependents.
class Tips {
public:
    Tips(const tree::VesselTree& tree, const tree::Dependency& dependency) : tree_(tree), dependency_(dependency) {
        sums_.resize(tree.branches.size());
        counts_.resize(tree.branches.size(), 0);
        // Each branch follows those that it depends on.
        for (std::size_t n = dependency.order().size(); n-- > 0;) {
            const int id = dependency.order()[n];
            const auto at = static_cast<std::size_t>(id);
            const tree::Branch& branch = tree.branches[at];
            if (branch.children.empty()) {
                sums_[at] += tree.points[branch.points.back()].position;
                ++counts_[at];
            }
            const int parent = dependency.parent(id);
            if (parent == tree::kNoBranch) continue;
            sums_[static_cast<std::size_t>(parent)] += sums_[at];
            counts_[static_cast<std::size_t>(parent)] += counts_[at];
        }
    }
    [[nodiscard]] std::size_t count(int branch) const { return counts_[static_cast<std::size_t>(branch)]; }
    [[nodiscard]] glm::dvec3 middle(int branch) const {
        return sums_[static_cast<std::size_t>(branch)] / static_cast<double>(count(branch));
    }
    // What hangs on a branch directly, the one with the most tips first.
    [[nodiscard]] std::vector<int> parts_of(int branch) const {
        std::vector<int> parts;
        for (const int id : dependency_.dependents(branch))
            if (dependency_.parent(id) == branch && count(id) > 0) parts.push_back(id);
        std::ranges::sort(parts, [&](int a, int b) { return std::tuple(count(b), a) < std::tuple(count(a), b); });
        return parts;
    }

private:
    const tree::VesselTree& tree_;
    const tree::Dependency& dependency_;
    std::vector<glm::dvec3> sums_;
    std::vector<std::size_t> counts_;
};

// The parts of a half that are named.
void add_parts(const Tips& tips, int branch, std::size_t of_half, std::vector<int>& parts) {
    const std::vector<int> next = tips.parts_of(branch);
    if (static_cast<double>(tips.count(branch)) <= kMostOfHalf * static_cast<double>(of_half) || next.empty()) {
        if (static_cast<double>(tips.count(branch)) >= kLeastOfHalf * static_cast<double>(of_half))
            parts.push_back(branch);
        return;
    }
    for (const int id : next) add_parts(tips, id, of_half, parts);
}

// Positions are RAS: x to the right, y to the front, z up.
int segment_on_right(const glm::dvec3& away) { return away.y > 0.0 ? (away.z > 0.0 ? 8 : 5) : (away.z > 0.0 ? 7 : 6); }
int segment_on_left(const glm::dvec3& away) { return away.x > 0.0 ? 4 : (away.z > away.y ? 2 : 3); }

} // namespace

Result<std::vector<SegmentSuggestion>> suggested_segments(const tree::VesselTree& tree,
                                                          const tree::Dependency& dependency, int system) {
    if (!tree.claims.has_sides())
        return fail("the patient's sides are not known", {}, "say where the axes of the file lead");
    const Tips tips(tree, dependency);
    int fork = tree::kNoBranch;
    for (std::size_t id = 0; id < tree.branches.size(); ++id)
        if (tree.branches[id].system == system && dependency.parent(static_cast<int>(id)) == tree::kNoBranch &&
            (fork == tree::kNoBranch || tips.count(static_cast<int>(id)) > tips.count(fork)))
            fork = static_cast<int>(id);
    std::vector<int> sides;
    while (fork != tree::kNoBranch) {
        sides = tips.parts_of(fork);
        std::erase_if(sides, [&](int id) {
            return static_cast<double>(tips.count(id)) < kLeastSide * static_cast<double>(tips.count(fork));
        });
        if (sides.size() != 1) break;
        fork = sides.front();
    }
    if (sides.size() < 2) return fail("the tree has no fork into a left and a right half");
    std::ranges::sort(sides, {}, [&](int id) { return tips.middle(id).x; });
    std::vector<SegmentSuggestion> suggestions;
    const auto add_half = [&](const std::vector<int>& branches, auto segment_of) {
        glm::dvec3 middle(0.0);
        std::size_t count = 0;
        for (const int id : branches) {
            middle += static_cast<double>(tips.count(id)) * tips.middle(id);
            count += tips.count(id);
        }
        middle /= static_cast<double>(count);
        std::vector<int> parts;
        for (const int id : branches) add_parts(tips, id, count, parts);
        for (const int id : parts) suggestions.push_back({id, segment_of(tips.middle(id) - middle), tips.count(id)});
    };
    add_half({sides.front()}, segment_on_left);
    add_half({sides.begin() + 1, sides.end()}, segment_on_right); // two where the trunk has three branches
    std::ranges::sort(suggestions, [](const SegmentSuggestion& a, const SegmentSuggestion& b) {
        return std::tuple(a.segment, b.tips, a.branch) < std::tuple(b.segment, a.tips, b.branch);
    });
    return suggestions;
}

} // namespace ramus::organ
