#include "core/tree/open_ends.h"

#include "core/base/disjoint_sets.h"
#include "core/tree/contacts/links.h"
#include "core/tree/contacts/touching_links.h"
#include "core/tree/prepare.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <map>
#include <optional>

namespace ramus::tree {

namespace {

// An end and the segment of another vessel that it lies in.
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

// The nearest segment along a branch between two of its points, if the end is within it.
void look_along(const VesselTree& tree, const Link& link, OpenEnd& end) {
    const std::vector<std::uint32_t>& points = tree.branches[static_cast<std::size_t>(link.branch)].points;
    const glm::dvec3 at = tree.points[end.point].position;
    auto next = std::ranges::find(points, link.from);
    for (; next != points.end() && *next != link.to && next + 1 != points.end(); ++next) {
        const Point& a = tree.points[*next];
        const Point& b = tree.points[next[1]];
        const glm::dvec3 way = b.position - a.position;
        const double share = std::clamp(glm::dot(at - a.position, way) / glm::dot(way, way), 0.0, 1.0);
        const double radius = glm::mix(a.radius, b.radius, share);
        const double depth = glm::distance(at, a.position + share * way) / radius;
        if (depth < end.depth) end = {depth, end.point, *next, next[1], share};
    }
}

std::vector<OpenEnd> find_open_ends(const Graph& graph, DisjointSets& pieces) {
    const PreparedTree prepared = tree_of(graph);
    const Links links(prepared);
    const TouchingLinks touching(links, 1.0); // who is in another's tube touches it
    std::vector<OpenEnd> ends(graph.points.size());
    const auto look = [&](std::uint32_t point, const Link& other) {
        if (links.at(point).size() != 1 || pieces.find(point) == pieces.find(other.from)) return;
        if (!graph.point_systems.empty() && graph.point_systems[point] != graph.point_systems[other.from]) return;
        ends[point].point = point;
        look_along(prepared.tree, other, ends[point]);
    };
    for (std::uint32_t n = 0; n < links.all().size(); ++n)
        for (std::uint32_t pair = touching.first(n); pair < touching.first(n + 1); ++pair) {
            const Link& a = links[n];
            const Link& b = links[touching.other(pair).link];
            look(a.from, b), look(a.to, b);
            look(b.from, a), look(b.to, a);
        }
    std::erase_if(ends, [](const OpenEnd& end) { return end.depth >= 1.0; });
    std::ranges::stable_sort(ends, {}, &OpenEnd::depth);
    return ends;
}

// Cuts segments at the places of ends that are joined, and connects these to them.
class Joiner {
public:
    explicit Joiner(Graph& graph) : graph_(graph), joined_(graph.points.size()) {}

    void join(const OpenEnd& end) {
        joined_[end.point] = 1;
        std::uint32_t host = 0;
        if (const auto near = near_point(end))
            host = *near;
        else
            host = cut(end);
        graph_.edges.emplace_back(end.point, host);
    }

    // Of each piece the thickest root that is no joined end, or else the thickest.
    void choose_roots() {
        DisjointSets pieces(graph_.points.size());
        for (const auto& [a, b] : graph_.edges) pieces.join(a, b);
        const auto better = [&](std::uint32_t a, std::uint32_t b) {
            const bool end_a = a < joined_.size() && joined_[a] != 0, end_b = b < joined_.size() && joined_[b] != 0;
            return end_a != end_b ? end_b : graph_.points[a].radius > graph_.points[b].radius;
        };
        std::map<std::uint32_t, std::uint32_t> kept; // by piece
        for (const std::uint32_t root : graph_.roots) {
            const auto [of_piece, first] = kept.emplace(pieces.find(root), root);
            if (!first && better(root, of_piece->second)) of_piece->second = root;
        }
        std::erase_if(graph_.roots, [&](std::uint32_t root) { return kept.at(pieces.find(root)) != root; });
    }

private:
    // A point that is about as near: no short segment is made beside it.
    [[nodiscard]] std::optional<std::uint32_t> near_point(const OpenEnd& end) const {
        constexpr double kNear = 0.25; // of the radius there
        const Point& a = graph_.points[end.from];
        const Point& b = graph_.points[end.to];
        const double length = glm::distance(a.position, b.position);
        const double near = kNear * glm::mix(a.radius, b.radius, end.share);
        if (end.share * length < near) return end.from;
        if ((1.0 - end.share) * length < near) return end.to;
        return std::nullopt;
    }

    std::uint32_t cut(const OpenEnd& end) {
        // The segment may have been cut before: then the part that the place is on.
        const Point& a = graph_.points[end.from];
        const Point& b = graph_.points[end.to];
        const Point middle{glm::mix(a.position, b.position, end.share), glm::mix(a.radius, b.radius, end.share)};
        const auto point = static_cast<std::uint32_t>(graph_.points.size());
        const Edge edge = part_of(end, middle.position);
        graph_.points.push_back(middle);
        if (!graph_.labels.empty()) graph_.labels.push_back(graph_.labels[end.from]);
        if (!graph_.point_systems.empty()) graph_.point_systems.push_back(graph_.point_systems[end.from]);
        *std::ranges::find(graph_.edges, edge) = {edge.first, point};
        graph_.edges.emplace_back(point, edge.second);
        cuts_.push_back({end.from, end.to, point});
        return point;
    }

    [[nodiscard]] Edge part_of(const OpenEnd& end, const glm::dvec3& place) const {
        std::vector<std::uint32_t> along{end.from, end.to};
        for (const Cut& cut : cuts_)
            if (cut.from == end.from && cut.to == end.to) along.push_back(cut.point);
        const glm::dvec3 start = graph_.points[end.from].position;
        std::ranges::sort(along, {}, [&](std::uint32_t p) { return glm::distance(graph_.points[p].position, start); });
        std::size_t n = 1;
        while (n + 1 < along.size() &&
               glm::distance(graph_.points[along[n]].position, start) < glm::distance(place, start))
            ++n;
        const Edge forth(along[n - 1], along[n]);
        return std::ranges::find(graph_.edges, forth) != graph_.edges.end() ? forth : Edge(along[n], along[n - 1]);
    }

    struct Cut {
        std::uint32_t from, to, point;
    };
    Graph& graph_;
    std::vector<std::uint8_t> joined_;
    std::vector<Cut> cuts_;
};

} // namespace

std::vector<std::uint32_t> join_open_ends(Graph& graph) {
    DisjointSets pieces(graph.points.size());
    for (const auto& [a, b] : graph.edges) pieces.join(a, b);
    if (graph.roots.size() < 2) return {};
    std::vector<std::uint32_t> joined;
    Joiner joiner(graph);
    for (const OpenEnd& end : find_open_ends(graph, pieces)) {
        if (!pieces.join(end.point, end.from)) continue;
        joiner.join(end);
        joined.push_back(end.point);
    }
    if (!joined.empty()) joiner.choose_roots();
    std::ranges::sort(joined);
    return joined;
}

} // namespace ramus::tree
