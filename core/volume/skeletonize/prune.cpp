#include "core/volume/skeletonize/prune.h"

#include "core/base/disjoint_sets.h"

#include <algorithm>
#include <functional>
#include <glm/geometric.hpp>
#include <set>
#include <utility>

namespace ramus::volume {

namespace {

// Appends `second` to `first` at their common node, which becomes a point.
void merge_at(VoxelGraph& graph, int node, VoxelGraph::Line& first, VoxelGraph::Line& second) {
    if (first.to != node) std::swap(first.from, first.to), std::ranges::reverse(first.points);
    if (second.from != node) std::swap(second.from, second.to), std::ranges::reverse(second.points);
    first.points.push_back(graph.nodes[static_cast<std::size_t>(node)]);
    first.points.insert(first.points.end(), second.points.begin(), second.points.end());
    first.to = second.to;
}

class BulgePruner {
public:
    BulgePruner(VoxelGraph& graph, double bulge_size, const glm::dvec3& spacing)
        : graph_(graph), bulge_size_(bulge_size), voxel_mm_(std::max({spacing.x, spacing.y, spacing.z})),
          rough_mm_(std::min({spacing.x, spacing.y, spacing.z})), at_(graph.nodes.size()),
          gone_(graph.lines.size(), false) {
        for (std::size_t l = 0; l < graph.lines.size(); ++l) {
            at_[static_cast<std::size_t>(graph.lines[l].from)].push_back(l);
            at_[static_cast<std::size_t>(graph.lines[l].to)].push_back(l);
        }
        for (std::size_t n = 0; n < at_.size(); ++n)
            if (at_[n].empty()) alone_.insert(n);
    }

    void run() {
        for (int n = 0; n < static_cast<int>(graph_.nodes.size()); ++n) merge_lines_at(n);
        for (std::size_t l = 0; l < graph_.lines.size(); ++l) consider(l);
        while (!open_.empty()) {
            const auto [length, l] = *open_.begin();
            open_.erase(open_.begin());
            if (gone_[l] || length != length_mm(graph_, graph_.lines[l]) || !is_bulge(l)) continue;
            remove(l);
        }
        std::vector<VoxelGraph::Line> kept;
        for (std::size_t l = 0; l < graph_.lines.size(); ++l)
            if (!gone_[l]) kept.push_back(std::move(graph_.lines[l]));
        graph_.lines = std::move(kept);
        drop_unused_nodes();
    }

private:
    [[nodiscard]] std::vector<std::size_t>& at(int node) { return at_[static_cast<std::size_t>(node)]; }

    void consider(std::size_t l) {
        if (!gone_[l] && is_bulge(l)) open_.insert({length_mm(graph_, graph_.lines[l]), l});
    }

    bool is_bulge(std::size_t l) {
        VoxelGraph::Line& line = graph_.lines[l];
        if (line.from == line.to) return false;
        const bool from_ends = at(line.from).size() == 1, to_ends = at(line.to).size() == 1;
        if (from_ends == to_ends) return false; // no leaf, or the only line of a piece
        const int node = from_ends ? line.to : line.from;
        const MidPoint &root = graph_.nodes[static_cast<std::size_t>(node)],
                       &end = graph_.nodes[static_cast<std::size_t>(from_ends ? line.from : line.to)];
        // The thickness of its part beyond the ball.
        double thickness = end.distance;
        for (const MidPoint& point : line.points)
            if (glm::distance(point.position, root.position) > root.distance)
                thickness = std::max(thickness, point.distance);
        const double least = bulge_size_ * thickness + voxel_mm_;
        if (length_mm(graph_, line) + end.distance - root.distance < least) return true;
        const std::vector<MidPoint> rest = rest_around(l, node);
        const auto stands_out = [&](const MidPoint& point) {
            return std::ranges::none_of(rest, [&](const MidPoint& ball) {
                return glm::distance(point.position, ball.position) + point.distance - ball.distance <
                       least + rough_mm_;
            });
        };
        return !stands_out(end) && std::ranges::none_of(line.points, stands_out);
    }

    // The points of the other lines at a node, within twice the radius of its ball.
    std::vector<MidPoint> rest_around(std::size_t l, int node) {
        const MidPoint& root = graph_.nodes[static_cast<std::size_t>(node)];
        std::vector<MidPoint> rest{root};
        for (const std::size_t other : at(node)) {
            if (other == l) continue;
            const auto add = [&](const MidPoint& point) {
                if (glm::distance(point.position, root.position) > 2.0 * root.distance) return false;
                rest.push_back(point);
                return true;
            };
            const VoxelGraph::Line& line = graph_.lines[other];
            if (line.from == node)
                for (auto point = line.points.begin(); point != line.points.end() && add(*point);) ++point;
            if (line.to == node)
                for (auto point = line.points.rbegin(); point != line.points.rend() && add(*point);) ++point;
        }
        return rest;
    }

    void remove(std::size_t l) {
        gone_[l] = true;
        const VoxelGraph::Line& line = graph_.lines[l];
        const int node = at(line.from).size() == 1 ? line.to : line.from;
        std::erase(at(line.from), l), std::erase(at(line.to), l);
        if (!merge_lines_at(node))
            for (const std::size_t other : at(node)) consider(other);
    }

    // Merges the lines at a node if there are exactly two, and they are not the two ends of a ring.
    bool merge_lines_at(int node) {
        const std::vector<std::size_t> left = at(node);
        if (left.size() != 2 || left[0] == left[1]) return false;
        merge_at(graph_, node, graph_.lines[left[0]], graph_.lines[left[1]]);
        gone_[left[1]] = true;
        at(node).clear();
        std::ranges::replace(at(graph_.lines[left[0]].to), left[1], left[0]);
        consider(left[0]);
        return true;
    }

    void drop_unused_nodes() {
        std::vector<int> renumbered(graph_.nodes.size(), -1);
        for (const VoxelGraph::Line& line : graph_.lines)
            renumbered[static_cast<std::size_t>(line.from)] = renumbered[static_cast<std::size_t>(line.to)] = 0;
        // A node that had no line from the beginning is a piece of one voxel, and stays.
        for (std::size_t n = 0; n < at_.size(); ++n)
            if (alone_.contains(n)) renumbered[n] = 0;
        std::vector<MidPoint> kept;
        for (std::size_t n = 0; n < renumbered.size(); ++n) {
            if (renumbered[n] < 0) continue;
            renumbered[n] = static_cast<int>(kept.size());
            kept.push_back(graph_.nodes[n]);
        }
        graph_.nodes = std::move(kept);
        for (VoxelGraph::Line& line : graph_.lines) {
            line.from = renumbered[static_cast<std::size_t>(line.from)];
            line.to = renumbered[static_cast<std::size_t>(line.to)];
        }
    }

    VoxelGraph& graph_;
    double bulge_size_;
    double voxel_mm_, rough_mm_;               // the longest side of a voxel, and the shortest
    std::vector<std::vector<std::size_t>> at_; // lines at each node; a ring twice
    std::vector<bool> gone_;
    std::set<std::pair<double, std::size_t>> open_;
    std::set<std::size_t> alone_;
};

} // namespace

std::vector<BrokenCycle> break_cycles(VoxelGraph& graph) {
    struct Width {
        BrokenCycle thinnest;
        std::size_t line;
    };
    std::vector<Width> widths;
    for (std::size_t l = 0; l < graph.lines.size(); ++l) {
        const VoxelGraph::Line& line = graph.lines[l];
        const MidPoint &a = graph.nodes[static_cast<std::size_t>(line.from)],
                       &b = graph.nodes[static_cast<std::size_t>(line.to)];
        MidPoint thinnest = a.distance < b.distance ? a : b;
        for (const MidPoint& point : line.points)
            if (point.distance < thinnest.distance) thinnest = point;
        widths.push_back({{thinnest.position, thinnest.distance}, l});
    }
    std::ranges::stable_sort(widths, std::ranges::greater{}, [](const Width& w) { return w.thinnest.distance; });
    DisjointSets joined(graph.nodes.size());
    std::vector<BrokenCycle> broken;
    std::vector<bool> goes(graph.lines.size(), false);
    for (const Width& width : widths) {
        const VoxelGraph::Line& line = graph.lines[width.line];
        if (joined.join(static_cast<std::uint32_t>(line.from), static_cast<std::uint32_t>(line.to))) continue;
        goes[width.line] = true;
        broken.push_back(width.thinnest);
    }
    std::vector<VoxelGraph::Line> kept;
    for (std::size_t l = 0; l < graph.lines.size(); ++l)
        if (!goes[l]) kept.push_back(std::move(graph.lines[l]));
    graph.lines = std::move(kept);
    return broken;
}

void prune_bulges(VoxelGraph& graph, double bulge_size, const glm::dvec3& spacing) {
    BulgePruner(graph, bulge_size, spacing).run();
}

} // namespace ramus::volume
