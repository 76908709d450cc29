#include "core/tree/build_tree.h"

#include "core/base/disjoint_sets.h"
#include "core/base/sort_unique.h"
#include "core/base/words.h"
#include "core/tree/open_ends.h"
#include "core/tree/suspicions.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <optional>

namespace ramus::tree {

namespace {

using SourceOf = std::function<std::string(std::uint32_t)>;

// Notes of what was repaired, and the first thing that should not have been.
struct Repairs {
    Repair allowed;
    std::vector<Note> done;
    std::optional<Error> refused;

    void add(Repair kind, std::string sentence, const glm::dvec3& at) {
        const std::string name(name_of(kind));
        if (!allows(allowed, kind) && !refused)
            refused = Error{"the file needs repair: " + sentence,
                            {},
                            "allow it with --repair usual or --repair " + name + ", or edit the file"};
        done.push_back({Note::Kind::kRepaired, name, std::move(sentence), at});
    }
};

std::optional<Error> find_bad_point(const Graph& graph, const SourceOf& source) {
    for (std::uint32_t i = 0; i < graph.points.size(); ++i) {
        const Point& p = graph.points[i];
        for (int axis = 0; axis < 3; ++axis) {
            const double c = p.position[axis];
            if (!std::isfinite(c))
                return Error{"a coordinate is not a finite number", source(i), "remove or correct the point"};
            if (std::abs(c) > kMaximumCoordinate)
                return Error{"coordinate " + in_digits(c) + " mm is farther out than " + in_digits(kMaximumCoordinate) +
                                 " mm",
                             source(i), "check the unit, or remove the point"};
        }
        if (!std::isfinite(p.radius))
            return Error{"the radius is not a finite number", source(i), "correct the radius"};
        if (p.radius < 0.0)
            return Error{"radius " + in_digits(p.radius) + " is negative", source(i),
                         "edit the file; a radius of 0 would be repaired"};
        if (p.radius > kMaximumRadius)
            return Error{"radius " + in_digits(p.radius) + " mm is larger than " + in_digits(kMaximumRadius) + " mm",
                         source(i), "check the unit, or correct the radius"};
    }
    for (const auto& [a, b] : graph.edges)
        if (a >= graph.points.size() || b >= graph.points.size())
            return Error{"an edge names point " + std::to_string(std::max(a, b)) + ", but there are only " +
                             std::to_string(graph.points.size()),
                         source(0), "edit the file"};
    if (!graph.point_systems.empty())
        for (const auto& [a, b] : graph.edges)
            if (graph.point_systems[a] != graph.point_systems[b])
                return Error{"two vessel systems are connected", source(b), "remove the connection"};
    return std::nullopt;
}

// Joins the ends of edges of no length. Returns for every point the point that stands for it.
std::vector<std::uint32_t> merge_repeated(const Graph& graph, Repairs& repairs, const SourceOf& source) {
    DisjointSets places(graph.points.size());
    for (const auto& [a, b] : graph.edges)
        if (graph.points[a].position == graph.points[b].position && places.join(a, b))
            repairs.add(Repair::kRepeatedPoints,
                        source(b) + ": merged with the point before it, which lies at the same place",
                        graph.points[b].position);
    std::vector<std::uint32_t> stands(graph.points.size());
    for (std::uint32_t p = 0; p < stands.size(); ++p) stands[p] = places.find(p);
    return stands;
}

// Zero radii become the mean of their neighbours' positive radii; a run of them fills up from its ends, one layer at a
// time, and each layer looks at its own points only. Returns a point that no positive radius reaches, if there is one.
std::optional<std::uint32_t> fill_radii(std::vector<Point>& points, const std::vector<Edge>& edges, Repairs& repairs,
                                        const SourceOf& source) {
    std::vector<Edge> around; // (point of radius 0, neighbour), sorted
    for (const auto& [a, b] : edges) {
        if (points[a].radius <= 0.0) around.emplace_back(a, b);
        if (points[b].radius <= 0.0) around.emplace_back(b, a);
    }
    std::ranges::sort(around);
    std::vector<std::uint32_t> layer;
    for (const auto& [p, neighbour] : around)
        if (points[neighbour].radius > 0.0 && (layer.empty() || layer.back() != p)) layer.push_back(p);
    while (!layer.empty()) {
        std::vector<double> radius;
        std::vector<std::uint32_t> next;
        for (const std::uint32_t p : layer) {
            double sum = 0.0;
            int count = 0;
            for (auto at = std::ranges::lower_bound(around, std::pair(p, 0U)); at != around.end() && at->first == p;
                 ++at) {
                if (points[at->second].radius > 0.0)
                    sum += points[at->second].radius, ++count;
                else
                    next.push_back(at->second);
            }
            radius.push_back(sum / count);
        }
        for (std::size_t n = 0; n < layer.size(); ++n) {
            points[layer[n]].radius = radius[n];
            repairs.add(Repair::kZeroRadii,
                        source(layer[n]) + ": radius 0 replaced by " + in_digits(radius[n]) +
                            ", the mean of its neighbours",
                        points[layer[n]].position);
        }
        sort_unique(next);
        std::erase_if(next, [&](std::uint32_t p) { return points[p].radius > 0.0; });
        layer = std::move(next);
    }
    for (const auto& [p, neighbour] : around)
        if (points[p].radius <= 0.0) return p;
    return std::nullopt;
}

// The edges between the points that are left (`stands`: which stands for each), each once.
std::vector<Edge> distinct_edges(const Graph& graph, const std::vector<std::uint32_t>& stands, Repairs& repairs,
                                 const SourceOf& source) {
    std::vector<Edge> edges = graph.edges;
    for (auto& [a, b] : edges) a = stands[a], b = stands[b];
    std::erase_if(edges, [](const Edge& edge) { return edge.first == edge.second; });
    std::vector<std::size_t> order(edges.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    const auto key = [&](std::size_t e) { return std::minmax(edges[e].first, edges[e].second); };
    std::ranges::stable_sort(order,
                             [&](std::size_t x, std::size_t y) { return std::pair(key(x)) < std::pair(key(y)); });
    std::vector<bool> twice(edges.size(), false);
    for (std::size_t n = 1; n < order.size(); ++n) {
        const auto x = key(order[n - 1]);
        const auto y = key(order[n]);
        if (x.first != y.first || x.second != y.second) continue;
        twice[order[n]] = true;
        repairs.add(Repair::kRepeatedPoints, source(y.second) + ": a repeated connection was left out",
                    graph.points[y.second].position);
    }
    std::vector<Edge> distinct;
    for (std::size_t e = 0; e < edges.size(); ++e)
        if (!twice[e]) distinct.push_back(edges[e]);
    return distinct;
}

} // namespace

std::string_view name_of(Repair one) { return paired(kRepairNames, one).value_or(""); }

std::vector<std::uint32_t> complete_roots(const std::vector<Point>& points, const std::vector<Edge>& edges,
                                          std::vector<std::uint32_t> roots) {
    DisjointSets components(points.size());
    std::vector<int> degree(points.size(), 0);
    for (const auto& [a, b] : edges) ++degree[a], ++degree[b], components.join(a, b);
    std::vector<bool> rooted(points.size(), false);
    for (const std::uint32_t root : roots) rooted[components.find(root)] = true;
    constexpr auto kUnset = static_cast<std::uint32_t>(-1);
    std::vector<std::uint32_t> best(points.size(), kUnset);
    for (std::uint32_t p = 0; p < points.size(); ++p) {
        if (degree[p] == 0 || rooted[components.find(p)]) continue;
        std::uint32_t& choice = best[components.find(p)];
        const auto rank = [&](std::uint32_t q) { return std::pair(degree[q] == 1, points[q].radius); };
        if (choice == kUnset || rank(p) > rank(choice)) choice = p;
    }
    for (const std::uint32_t choice : best)
        if (choice != kUnset) roots.push_back(choice);
    return roots;
}

void note_network(VesselTree& tree) {
    std::erase_if(tree.notes, [](const Note& note) { return note.topic == "loops" || note.topic == "pieces"; });
    std::ranges::move(check_network(tree), std::back_inserter(tree.notes));
}

Result<VesselTree> build_tree(Graph graph, Repair repair, const SourceOf& source) {
    if (auto error = find_bad_point(graph, source)) return tl::unexpected(std::move(*error));
    if (std::ranges::none_of(graph.points, [](const Point& p) { return p.radius > 0.0; }))
        return fail("no point has a positive radius", graph.points.empty() ? std::string() : source(0),
                    "the tree needs radii; check that the radius column is filled");

    Repairs repairs{repair, {}, {}};
    const std::vector<std::uint32_t> stands = merge_repeated(graph, repairs, source);

    std::vector<Edge> edges = distinct_edges(graph, stands, repairs, source);
    std::vector<bool> connected(graph.points.size(), false);
    for (const auto& [a, b] : edges) connected[a] = connected[b] = true;
    if (edges.empty())
        return fail("the tree has no segment: a vessel needs two points at different places",
                    graph.points.empty() ? std::string() : source(0), "check that points are connected to each other");
    for (std::uint32_t p = 0; p < graph.points.size(); ++p)
        if (!connected[p] && stands[p] == p)
            repairs.add(Repair::kLonelyPoints, source(p) + ": a point connected to nothing was left out",
                        graph.points[p].position);

    if (const auto unfilled = fill_radii(graph.points, edges, repairs, source))
        return fail("the vessel of this point has no positive radius anywhere", source(*unfilled),
                    "give at least one of its points a radius");
    if (repairs.refused) return tl::unexpected(std::move(*repairs.refused));

    // Points that are left, renumbered in their old order.
    std::vector<std::uint32_t> renumbered(graph.points.size(), 0), kept;
    Graph left;
    for (std::uint32_t p = 0; p < graph.points.size(); ++p) {
        if (!connected[p]) continue;
        renumbered[p] = static_cast<std::uint32_t>(kept.size());
        kept.push_back(p);
        left.points.push_back(graph.points[p]);
        if (!graph.labels.empty()) left.labels.push_back(graph.labels[p]);
        if (!graph.point_systems.empty()) left.point_systems.push_back(graph.point_systems[p]);
    }
    left.edges = std::move(edges);
    for (auto& [a, b] : left.edges) a = renumbered[a], b = renumbered[b];
    std::ranges::move(check_radii(left.points, left.edges, allows(repair, Repair::kRadiusJumps)),
                      std::back_inserter(repairs.done));
    for (const std::uint32_t root : graph.roots)
        if (root < stands.size() && connected[stands[root]]) left.roots.push_back(renumbered[stands[root]]);
    left.roots = complete_roots(left.points, left.edges, std::move(left.roots));
    if (allows(repair, Repair::kOpenEnds))
        for (const std::uint32_t end : join_open_ends(left))
            repairs.add(Repair::kOpenEnds, source(kept[end]) + ": an end within another vessel was joined to it",
                        graph.points[kept[end]].position);
    VesselTree tree =
        assemble(std::move(left.points), std::move(left.labels), left.edges, left.roots, left.point_systems);
    tree.systems = std::move(graph.systems);
    tree.notes = std::move(repairs.done);
    std::ranges::move(check_network(tree), std::back_inserter(tree.notes));
    return tree;
}

} // namespace ramus::tree
