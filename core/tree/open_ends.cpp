#include "core/tree/open_ends.h"

#include "core/base/disjoint_sets.h"
#include "core/tree/contacts/links.h"
#include "core/tree/contacts/touching_links.h"
#include "core/tree/prepare.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <iterator>
#include <map>
#include <numeric>
#include <optional>

namespace ramus::tree {

namespace {

// An end, and the segment of another vessel that contains it.
struct OpenEnd {
    double depth = 1.0; // of its distance from the other axis, in radii there
    std::uint32_t point = 0, from = 0, to = 0;
    double share = 0.0; // of the way from the one to the other
};

PreparedTree tree_of(const Graph& graph) {
    PreparedTree prepared;
    prepared.tree = assemble(graph.points, {}, graph.edges, graph.roots);
    for (std::size_t b = 0; b < prepared.tree.branches.size(); ++b)
        prepared.segment_source.insert(prepared.segment_source.end(), prepared.tree.branches[b].points.size() - 1,
                                       static_cast<int>(b));
    return prepared;
}

// By point: its place along its branch. Not meaningful for the ends of branches.
std::vector<std::uint32_t> places_along(const VesselTree& tree) {
    std::vector<std::uint32_t> places(tree.points.size(), 0);
    for (const Branch& branch : tree.branches)
        for (std::uint32_t i = 1; i + 1 < branch.points.size(); ++i) places[branch.points[i]] = i;
    return places;
}

// The nearest segment of a link, if the end is within it.
void look_along(const VesselTree& tree, const std::vector<std::uint32_t>& places, const Link& link, OpenEnd& end) {
    const std::vector<std::uint32_t>& points = tree.branches[static_cast<std::size_t>(link.branch)].points;
    const glm::dvec3 at = tree.points[end.point].position;
    const std::size_t first = link.from == points.front() ? 0 : places[link.from];
    for (std::size_t i = first; i + 1 < points.size(); ++i) {
        const Point& a = tree.points[points[i]];
        const Point& b = tree.points[points[i + 1]];
        const glm::dvec3 way = b.position - a.position;
        const double share = share_along(at - a.position, way);
        const double radius = glm::mix(a.radius, b.radius, share);
        const double depth = glm::distance(at, a.position + share * way) / radius;
        if (depth < end.depth) end = {depth, end.point, points[i], points[i + 1], share};
        if (points[i + 1] == link.to) break;
    }
}

std::vector<OpenEnd> find_open_ends(const Graph& graph, DisjointSets& pieces) {
    const PreparedTree prepared = tree_of(graph);
    const Links links(prepared);
    const TouchingLinks touching(links, 1.0, 1.0); // an end inside a tube touches it
    const std::vector<std::uint32_t> places = places_along(prepared.tree);
    std::vector<OpenEnd> ends(graph.points.size());
    const auto look = [&](std::uint32_t point, const Link& other) {
        if (links.at(point).size() != 1 || pieces.find(point) == pieces.find(other.from)) return;
        if (!graph.point_systems.empty() && graph.point_systems[point] != graph.point_systems[other.from]) return;
        ends[point].point = point;
        look_along(prepared.tree, places, other, ends[point]);
    };
    for (std::uint32_t n = 0; n < links.size(); ++n)
        for (std::uint32_t pair = touching.first(n); pair < touching.first(n + 1); ++pair) {
            const Link a = links[n];
            const Link b = links[touching.other(pair).link];
            look(a.from, b), look(a.to, b);
            look(b.from, a), look(b.to, a);
        }
    std::erase_if(ends, [](const OpenEnd& end) { return end.depth >= 1.0; });
    std::ranges::stable_sort(ends, {}, &OpenEnd::depth);
    return ends;
}

// In radii: an end nearer than this to the other axis is on the axis.
constexpr double kSamePlace = 1e-3;

// Divides segments at the places of joined ends, and connects the ends.
class Joiner {
public:
    explicit Joiner(Graph& graph) : graph_(graph), joined_(graph.points.size(), 0), edges_at_(graph.points.size()) {
        stands_.resize(graph.points.size());
        std::iota(stands_.begin(), stands_.end(), 0U);
        for (std::uint32_t e = 0; e < graph.edges.size(); ++e) place_edge(e);
    }

    void join(const OpenEnd& end) {
        joined_[end.point] = 1;
        const auto near = near_point(end);
        const bool same = is_on_axis(end, near) && !(near && leads_to_place_of(end.point, *near));
        if (!near)
            cut(end, same);
        else if (same)
            replace(end.point, *near);
        else
            add_edge({end.point, *near});
    }

    // Keeps in each piece the thickest root that is no joined end, or else the thickest root.
    void choose_roots() {
        for (std::uint32_t& root : graph_.roots) root = standing(root);
        DisjointSets pieces(graph_.points.size());
        for (const auto& [a, b] : graph_.edges) pieces.join(a, b);
        const auto is_joined = [&](std::uint32_t p) { return p < joined_.size() && joined_[p] != 0; };
        const auto better = [&](std::uint32_t a, std::uint32_t b) {
            return is_joined(a) != is_joined(b) ? is_joined(b) : graph_.points[a].radius > graph_.points[b].radius;
        };
        std::map<std::uint32_t, std::uint32_t> kept; // by piece
        for (const std::uint32_t root : graph_.roots) {
            const auto [of_piece, first] = kept.emplace(pieces.find(root), root);
            if (!first && better(root, of_piece->second)) of_piece->second = root;
        }
        std::vector<std::uint32_t> roots;
        for (const std::uint32_t root : graph_.roots) {
            const auto of_piece = kept.find(pieces.find(root));
            if (of_piece == kept.end() || of_piece->second != root) continue;
            roots.push_back(root);
            kept.erase(of_piece);
        }
        graph_.roots = std::move(roots);
    }

    // Points that were merged into others are removed.
    void compact() {
        std::vector<std::uint32_t> number(graph_.points.size(), 0), kept;
        for (std::uint32_t p = 0; p < graph_.points.size(); ++p) {
            if (standing(p) != p) continue;
            number[p] = static_cast<std::uint32_t>(kept.size());
            kept.push_back(p);
        }
        graph_.keep_points(kept);
        for (auto& [a, b] : graph_.edges) a = number[a], b = number[b];
        for (std::uint32_t& root : graph_.roots) root = number[root];
    }

private:
    [[nodiscard]] std::uint32_t standing(std::uint32_t point) const {
        while (point < stands_.size() && stands_[point] != point) point = stands_[point];
        return point;
    }
    static Edge either_way(const Edge& edge) { return std::minmax(edge.first, edge.second); }
    void place_edge(std::uint32_t e) {
        const Edge& edge = graph_.edges[e];
        place_of_[either_way(edge)] = e;
        for (const std::uint32_t point : {edge.first, edge.second}) edges_at_[point].push_back(e);
    }
    void change_edge(std::uint32_t e, const Edge& changed) {
        Edge& edge = graph_.edges[e];
        place_of_.erase(either_way(edge));
        for (const std::uint32_t point : {edge.first, edge.second}) std::erase(edges_at_[point], e);
        edge = changed;
        place_edge(e);
    }
    // `like`: the edge that contains the new edge.
    void add_edge(const Edge& edge, std::optional<std::uint32_t> like = {}) {
        graph_.edges.push_back(edge);
        like ? append_copy(graph_.edge_data, *like) : append_unknown(graph_.edge_data);
        place_edge(static_cast<std::uint32_t>(graph_.edges.size() - 1));
    }

    [[nodiscard]] bool is_on_axis(const OpenEnd& end, std::optional<std::uint32_t> near) const {
        return end.depth < kSamePlace || (near && graph_.points[*near].position == graph_.points[end.point].position);
    }
    // Whether a neighbour of the end has the position of the point. Then the end must keep its own place between them.
    [[nodiscard]] bool leads_to_place_of(std::uint32_t end, std::uint32_t point) const {
        return std::ranges::any_of(edges_at_[end], [&](std::uint32_t e) {
            const Edge& edge = graph_.edges[e];
            const std::uint32_t neighbour = edge.first == end ? edge.second : edge.first;
            return graph_.points[neighbour].position == graph_.points[point].position;
        });
    }

    // An end point of the segment, or a point where it was divided, that is about as near. Avoids short segments.
    [[nodiscard]] std::optional<std::uint32_t> near_point(const OpenEnd& end) const {
        constexpr double kNear = 0.25; // of the radius there
        const Point& a = graph_.points[end.from];
        const Point& b = graph_.points[end.to];
        const double length = glm::distance(a.position, b.position);
        std::optional<std::uint32_t> nearest;
        double away = kNear * glm::mix(a.radius, b.radius, end.share);
        const auto look = [&](double share, std::uint32_t point) {
            const double distance = std::abs(end.share - share) * length;
            if (distance < away) away = distance, nearest = point;
        };
        look(0.0, standing(end.from));
        look(1.0, standing(end.to));
        if (const auto cuts = cuts_.find({end.from, end.to}); cuts != cuts_.end())
            for (const Cut& cut : cuts->second) look(cut.share, standing(cut.point));
        return nearest;
    }

    // An end on the other axis becomes the new point itself.
    void cut(const OpenEnd& end, bool same) {
        const Point& a = graph_.points[end.from];
        const Point& b = graph_.points[end.to];
        const double radius = glm::mix(a.radius, b.radius, end.share);
        // If the segment has been divided before, use the part that contains the place.
        std::vector<Cut>& cuts = cuts_[{end.from, end.to}];
        const auto next = std::ranges::upper_bound(cuts, end.share, {}, &Cut::share);
        const std::uint32_t before = next == cuts.begin() ? standing(end.from) : std::prev(next)->point;
        const std::uint32_t behind = next == cuts.end() ? standing(end.to) : next->point;
        const std::uint32_t point = same ? end.point : static_cast<std::uint32_t>(graph_.points.size());
        cuts.insert(next, {end.share, point});
        if (!same) {
            graph_.add_point_between(end.from, end.to, end.share);
            edges_at_.emplace_back();
            add_edge({end.point, point});
        } else {
            graph_.points[point].radius = std::max(graph_.points[point].radius, radius);
        }
        const std::uint32_t own = place_of_.at(either_way({before, behind}));
        change_edge(own, {before, point});
        add_edge({point, behind}, own);
    }

    // Merges an end into a point at the same place. Its neighbours, including ends joined to it, are connected to that
    // point.
    void replace(std::uint32_t end, std::uint32_t host) {
        stands_[end] = host;
        const auto standing = [&](std::uint32_t point) { return point == end ? host : point; };
        const std::vector<std::uint32_t> edges = edges_at_[end];
        for (const std::uint32_t e : edges)
            change_edge(e, {standing(graph_.edges[e].first), standing(graph_.edges[e].second)});
    }

    struct Cut {
        double share; // of the way along the segment as it was
        std::uint32_t point;
    };
    Graph& graph_;
    std::vector<std::uint8_t> joined_; // by point, as it was before
    std::vector<std::vector<std::uint32_t>> edges_at_;
    std::vector<std::uint32_t> stands_; // the point that stands for it
    std::map<Edge, std::uint32_t> place_of_;
    std::map<Edge, std::vector<Cut>> cuts_; // of a segment as it was, in order along it
};

} // namespace

std::vector<std::uint32_t> join_open_ends(Graph& graph) {
    if (graph.roots.size() < 2) return {}; // one piece
    DisjointSets pieces(graph.points.size());
    for (const auto& [a, b] : graph.edges) pieces.join(a, b);
    const std::vector<OpenEnd> ends = find_open_ends(graph, pieces);
    if (ends.empty()) return {};
    std::vector<std::uint32_t> joined;
    Joiner joiner(graph);
    for (const OpenEnd& end : ends) {
        if (!pieces.join(end.point, end.from)) continue;
        joiner.join(end);
        joined.push_back(end.point);
    }
    joiner.choose_roots();
    joiner.compact();
    std::ranges::sort(joined);
    return joined;
}

} // namespace ramus::tree
