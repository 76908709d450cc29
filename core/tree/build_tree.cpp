#include "core/tree/build_tree.h"

#include "core/base/disjoint_sets.h"
#include "core/base/sort_unique.h"
#include "core/base/words.h"
#include "core/tree/branch_data.h"
#include "core/tree/missing_radii.h"
#include "core/tree/open_ends.h"
#include "core/tree/suspicions.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <iterator>
#include <numeric>
#include <optional>

namespace ramus::tree {

namespace {

using SourceOf = std::function<std::string(std::uint32_t)>;

// Collects notes of repairs, and the first repair that is not allowed.
struct Repairs {
    Repair allowed;
    std::vector<Note> done;
    std::optional<Error> refused;

    void add(Repair kind, std::string sentence, const glm::dvec3& at) {
        const std::string name(name_of(kind));
        if (!allows(allowed, kind) && !refused)
            refused = Error{"the file needs repair: " + sentence,
                            {},
                            (allows(Repair::kUsual, kind) ? "allow it with --repair usual or --repair "
                                                          : "allow it with --repair all or --repair ") +
                                name + ", or edit the file"};
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
        if (p.radius == kNotMeasured) continue;
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

// Returns how many points got an interpolated radius.
Result<std::size_t> fill_radii(std::vector<Point>& points, const std::vector<Edge>& edges, Repairs& repairs,
                               const SourceOf& source) {
    const std::vector<Point> read = points;
    const FilledRadii filled = fill_missing_radii(points, edges);
    if (filled.out_of_reach)
        return fail("the vessel of this point has no positive radius anywhere", source(*filled.out_of_reach),
                    "give at least one of its points a radius");
    for (const std::uint32_t p : filled.points) {
        const bool measured = read[p].radius != kNotMeasured;
        repairs.add(
            measured ? Repair::kZeroRadii : Repair::kUnmeasuredRadii,
            source(p) +
                (measured ? ": radius 0 replaced by " : ": the radius was not measured (-1 or NaN); taken as ") +
                in_digits(points[p].radius) + ", interpolated between its neighbours",
            points[p].position);
    }
    return filled.points.size();
}

// The edges between the remaining points, each once. `stands`: by point, the point that represents it. `left` receives
// the index of each edge in the graph.
std::vector<Edge> distinct_edges(const Graph& graph, const std::vector<std::uint32_t>& stands, Repairs& repairs,
                                 const SourceOf& source, std::vector<std::size_t>& left) {
    std::vector<Edge> edges = graph.edges;
    std::vector<std::size_t> order;
    for (std::size_t e = 0; e < edges.size(); ++e) {
        auto& [a, b] = edges[e];
        a = stands[a], b = stands[b];
        if (a != b) order.push_back(e);
    }
    left = order;
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
    std::erase_if(left, [&](std::size_t e) { return bool(twice[e]); });
    for (const std::size_t e : left) distinct.push_back(edges[e]);
    return distinct;
}

} // namespace

std::string_view name_of(Repair one) { return paired(kRepairNames, one).value_or(""); }

std::uint32_t Graph::add_point_between(std::uint32_t a, std::uint32_t b, double share) {
    points.push_back(
        {glm::mix(points[a].position, points[b].position, share), glm::mix(points[a].radius, points[b].radius, share)});
    if (!labels.empty()) labels.push_back(labels[a]);
    if (!point_systems.empty()) point_systems.push_back(point_systems[a]);
    append_between(point_data, a, b, share);
    return static_cast<std::uint32_t>(points.size() - 1);
}

void Graph::keep_points(const std::vector<std::uint32_t>& kept) {
    const auto keep = [&](auto& values) {
        if (values.empty()) return;
        for (std::size_t n = 0; n < kept.size(); ++n) values[n] = values[kept[n]];
        values.resize(kept.size());
    };
    keep(points), keep(labels), keep(point_systems);
    for (DataArray& array : point_data) keep(array.values);
}

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
                    "the tree needs radii; check that the radius column is filled, or give all points the same "
                    "radius with --radius MM");

    Repairs repairs{repair, {}, {}};
    const std::vector<std::uint32_t> stands = merge_repeated(graph, repairs, source);

    std::vector<std::size_t> left_edges;
    std::vector<Edge> edges = distinct_edges(graph, stands, repairs, source, left_edges);
    std::vector<bool> connected(graph.points.size(), false);
    for (const auto& [a, b] : edges) connected[a] = connected[b] = true;
    if (edges.empty())
        return fail("the tree has no segment: a vessel needs two points at different places",
                    graph.points.empty() ? std::string() : source(0), "check that points are connected to each other");
    for (std::uint32_t p = 0; p < graph.points.size(); ++p)
        if (!connected[p] && stands[p] == p)
            repairs.add(Repair::kLonelyPoints, source(p) + ": a point connected to nothing was left out",
                        graph.points[p].position);

    RAMUS_TRY(filled, fill_radii(graph.points, edges, repairs, source));
    if (repairs.refused) return tl::unexpected(std::move(*repairs.refused));

    // The remaining points, renumbered in their old order.
    std::vector<std::uint32_t> renumbered(graph.points.size(), 0), kept;
    for (std::uint32_t p = 0; p < graph.points.size(); ++p) {
        if (!connected[p]) continue;
        renumbered[p] = static_cast<std::uint32_t>(kept.size());
        kept.push_back(p);
    }
    Graph left = graph;
    left.keep_points(kept);
    left.roots.clear();
    left.edge_data = picked(graph.edge_data, left_edges);
    left.edges = std::move(edges);
    for (auto& [a, b] : left.edges) a = renumbered[a], b = renumbered[b];
    const std::size_t invented = graph.radii_are_invented ? left.points.size() : filled;
    if (auto note = check_invented(invented, left.points.size())) repairs.done.push_back(std::move(*note));
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
    tree.point_data = std::move(left.point_data);
    tree.branch_data = branch_data_of_edges(tree, left.edges, left.edge_data);
    tree.systems = std::move(graph.systems);
    tree.notes = std::move(repairs.done);
    std::ranges::move(check_network(tree), std::back_inserter(tree.notes));
    return tree;
}

} // namespace ramus::tree
