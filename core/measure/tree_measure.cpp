#include "core/measure/tree_measure.h"

#include "core/base/infinity.h"
#include "core/measure/branch_point.h"
#include "core/tree/network.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <queue>

namespace ramus::measure {

namespace {

// The centerline between two fractions, from the first to the second.
void append_places(const tree::VesselTree& tree, int branch, double from, double to, std::vector<glm::dvec3>& places) {
    const auto& points = tree.branches[static_cast<std::size_t>(branch)].points;
    const double length = tree::length_mm(tree, tree.branches[static_cast<std::size_t>(branch)]);
    std::vector<glm::dvec3> way{point_on(tree, branch, std::min(from, to)).position};
    double before = 0.0;
    for (std::size_t i = 1; i + 1 < points.size(); ++i) {
        before += glm::distance(tree.points[points[i - 1]].position, tree.points[points[i]].position);
        if (before > std::min(from, to) * length && before < std::max(from, to) * length)
            way.push_back(tree.points[points[i]].position);
    }
    way.push_back(point_on(tree, branch, std::max(from, to)).position);
    if (from > to) std::ranges::reverse(way);
    for (const glm::dvec3& place : way)
        if (places.empty() || places.back() != place) places.push_back(place);
}

double degrees_between(const glm::dvec3& a, const glm::dvec3& b) {
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)) * 180.0 / std::numbers::pi;
}

constexpr double kChordDiameters = 1.5; // tuned: beyond the voxels' noise, before most vessels bend away

// The chord direction from an end of the branch into the branch.
glm::dvec3 chord(const tree::VesselTree& tree, int branch, bool from_end) {
    const tree::Branch& whole = tree.branches[static_cast<std::size_t>(branch)];
    const tree::Point& node = tree.points[from_end ? whole.points.back() : whole.points.front()];
    const double length = tree::length_mm(tree, whole);
    const double share = std::min(kChordDiameters * 2.0 * node.radius / length, 1.0);
    const BranchPoint place = point_on(tree, branch, from_end ? 1.0 - share : share);
    const glm::dvec3 way = place.position - node.position;
    const double far = glm::length(way);
    if (far > 1e-9 * length) return way / far;
    return from_end ? -point_on(tree, branch, 1.0).direction : point_on(tree, branch, 0.0).direction; // a ring
}

} // namespace

namespace {

// The shortest paths from one place to all nodes (Dijkstra).
class Ways {
public:
    Ways(const tree::VesselTree& tree, const BranchPlace& from)
        : network_(tree), from_(from), best_(index(network_.node_count()), kInfinity),
          through_(index(network_.node_count()), tree::kNoBranch) {
        length_.reserve(tree.branches.size());
        for (const tree::Branch& branch : tree.branches) length_.push_back(tree::length_mm(tree, branch));
        const auto [start, end] = network_.ends[index(from.branch)];
        offer(start, from.fraction * length_of(from.branch), from.branch);
        offer(end, (1.0 - from.fraction) * length_of(from.branch), from.branch);
        while (!open_.empty()) {
            const auto [far, node] = open_.top();
            open_.pop();
            if (far > best_[index(node)]) continue;
            for (const int branch : network_.at(node))
                offer(network_.across(branch, node), far + length_of(branch), branch);
        }
    }

    [[nodiscard]] double length_of(int branch) const { return length_[index(branch)]; }
    // The distance to an end of a branch (0: the parent's end); infinite if it is not reachable.
    [[nodiscard]] double to_end(int branch, int end) const { return best_[index(node_at(branch, end))]; }
    [[nodiscard]] int node_at(int branch, int end) const { return network_.ends[index(branch)][index(end)]; }
    // The branches of the path to a node, the last first, each with the fraction at which the path enters it. The final
    // entry is the branch where the path begins, with the end at which the path leaves it.
    [[nodiscard]] std::vector<BranchPlace> back_from(int node) const {
        std::vector<BranchPlace> back;
        while (true) {
            const int branch = through_[index(node)];
            const auto [start, end] = network_.ends[index(branch)];
            if (branch == from_.branch) {
                const bool at_end = end == node && (start != node || from_.fraction > 0.5);
                back.push_back({branch, at_end ? 1.0 : 0.0});
                return back;
            }
            back.push_back({branch, end == node ? 0.0 : 1.0});
            node = network_.across(branch, node);
        }
    }

private:
    [[nodiscard]] static std::size_t index(int number) { return static_cast<std::size_t>(number); }
    void offer(int node, double far, int branch) {
        if (far >= best_[index(node)]) return;
        best_[index(node)] = far;
        through_[index(node)] = branch;
        open_.emplace(far, node);
    }

    using Open = std::pair<double, int>;
    tree::Network network_;
    BranchPlace from_;
    std::vector<double> length_, best_;
    std::vector<int> through_;
    std::priority_queue<Open, std::vector<Open>, std::greater<>> open_;
};

} // namespace

std::optional<Path> path_between(const tree::VesselTree& tree, const BranchPlace& from, const BranchPlace& to) {
    Path path;
    path.branches = {from.branch};
    const Ways ways(tree, from);
    const double length = ways.length_of(to.branch);
    const double by_start = ways.to_end(to.branch, 0) + to.fraction * length;
    const double by_end = ways.to_end(to.branch, 1) + (1.0 - to.fraction) * length;
    path.length_mm = std::min(by_start, by_end);
    if (from.branch == to.branch && std::abs(from.fraction - to.fraction) * length <= path.length_mm) {
        path.length_mm = std::abs(from.fraction - to.fraction) * length;
        append_places(tree, from.branch, from.fraction, to.fraction, path.places);
        return path;
    }
    if (path.length_mm == kInfinity) return {};
    const int enters = by_start <= by_end ? 0 : 1;
    std::vector<BranchPlace> back = ways.back_from(ways.node_at(to.branch, enters));
    append_places(tree, from.branch, from.fraction, back.back().fraction, path.places);
    back.pop_back();
    for (std::size_t i = back.size(); i-- > 0;) {
        path.branches.push_back(back[i].branch);
        append_places(tree, back[i].branch, back[i].fraction, 1.0 - back[i].fraction, path.places);
    }
    path.branches.push_back(to.branch);
    append_places(tree, to.branch, enters, to.fraction, path.places);
    return path;
}

double angle_deg(const glm::dvec3& from, const glm::dvec3& apex, const glm::dvec3& to) {
    return degrees_between(from - apex, to - apex);
}

glm::dvec3 start_direction(const tree::VesselTree& tree, int branch) { return chord(tree, branch, false); }
glm::dvec3 end_direction(const tree::VesselTree& tree, int branch) { return -chord(tree, branch, true); }

Branching branching_of(const tree::VesselTree& tree, int branch) {
    const tree::Branch& own = tree.branches[static_cast<std::size_t>(branch)];
    Branching found;
    found.place = tree.points[own.points.front()].position;
    const glm::dvec3 direction = start_direction(tree, branch);
    if (own.parent != tree::kNoBranch)
        found.to_parent_deg = degrees_between(end_direction(tree, own.parent), direction);
    for (std::size_t b = 0; b < tree.branches.size(); ++b) {
        const int other = static_cast<int>(b);
        if (other == branch || tree.branches[b].points.front() != own.points.front()) continue;
        found.siblings_deg.emplace_back(other, degrees_between(direction, start_direction(tree, other)));
    }
    return found;
}

TreeStatistics tree_statistics(const tree::VesselTree& tree) {
    TreeStatistics all;
    all.branches.reserve(tree.branches.size());
    double radius_times_length = 0.0;
    double least = std::numeric_limits<double>::max();
    for (const tree::Branch& branch : tree.branches) {
        BranchStatistics one;
        one.diameter_mm.min = std::numeric_limits<double>::max();
        double diameter_times_length = 0.0;
        for (std::size_t i = 0; i < branch.points.size(); ++i) {
            const tree::Point& end = tree.points[branch.points[i]];
            one.diameter_mm.min = std::min(one.diameter_mm.min, 2.0 * end.radius);
            one.diameter_mm.max = std::max(one.diameter_mm.max, 2.0 * end.radius);
            if (i == 0) continue;
            const tree::Point& start = tree.points[branch.points[i - 1]];
            const double length = glm::distance(start.position, end.position);
            one.length_mm += length;
            diameter_times_length += length * (start.radius + end.radius);
            one.volume_mm3 += std::numbers::pi / 3.0 * length *
                              (start.radius * start.radius + start.radius * end.radius + end.radius * end.radius);
        }
        one.diameter_mm.mean = diameter_times_length / one.length_mm; // positive: a branch has a length
        all.length_mm += one.length_mm;
        all.volume_mm3 += one.volume_mm3;
        radius_times_length += diameter_times_length / 2.0;
        least = std::min(least, one.diameter_mm.min / 2.0);
        all.radius_mm.max = std::max(all.radius_mm.max, one.diameter_mm.max / 2.0);
        all.generations = std::max(all.generations, branch.generation + 1);
        all.highest_strahler = std::max(all.highest_strahler, branch.strahler);
        if (branch.children.empty()) ++all.leaves;
        all.branches.push_back(one);
    }
    if (!tree.branches.empty()) {
        all.radius_mm.min = least;
        all.radius_mm.mean = radius_times_length / all.length_mm;
    }
    return all;
}

} // namespace ramus::measure
