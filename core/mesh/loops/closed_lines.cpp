#include "core/mesh/loops/closed_lines.h"

#include "core/base/disjoint_sets.h"
#include "core/base/splitmix64.h"

#include <algorithm>
#include <functional>
#include <glm/geometric.hpp>
#include <iterator>
#include <limits>
#include <map>
#include <oneapi/tbb/parallel_sort.h>
#include <queue>
#include <utility>

namespace ramus::mesh {

namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

struct Reached {
    double distance;
    std::uint32_t vertex;
    bool operator>(const Reached& other) const {
        return distance != other.distance ? distance > other.distance : vertex > other.vertex;
    }
};
using Front = std::priority_queue<Reached, std::vector<Reached>, std::greater<>>;

constexpr std::size_t kBits = 128; // of a label

void flip(HomologyClass& bits, const HomologyClass& by) {
    for (std::size_t n = 0; n < by.size(); ++n) bits[n] ^= by[n];
}

bool any(const HomologyClass& bits) { return (bits[0] | bits[1]) != 0; }

} // namespace

std::vector<glm::dvec3> positions_of(const TriangleMesh& mesh, const ClosedLine& line) {
    std::vector<glm::dvec3> positions;
    for (const std::uint32_t v : line.vertices) positions.emplace_back(mesh.positions[v]);
    return positions;
}

HomologyClass IndependentClasses::rest(HomologyClass homology) const {
    for (const HomologyClass& other : rests_) {
        HomologyClass without = homology;
        flip(without, other);
        homology = std::min(homology, without);
    }
    return homology;
}

// The shortest paths from one vertex of each piece.
struct ClosedLines::Tree {
    std::vector<double> distance;
    std::vector<std::uint32_t> edge; // toward the start, by vertex
};

ClosedLines::Tree ClosedLines::shortest_paths(Job& job) const {
    const std::size_t count = graph_.mesh().positions.size();
    Tree tree{std::vector<double>(count, std::numeric_limits<double>::max()), std::vector<std::uint32_t>(count, kNone)};
    Front front;
    for (std::uint32_t start = 0; start < count; ++start) {
        if (graph_.edges_at(start).empty() || tree.distance[start] < std::numeric_limits<double>::max()) continue;
        tree.distance[start] = 0.0;
        front.push({0.0, start});
        while (!front.empty() && !job.cancelled()) {
            const auto [distance, vertex] = front.top();
            front.pop();
            if (distance > tree.distance[vertex]) continue;
            for (const std::uint32_t edge : graph_.edges_at(vertex)) {
                const std::uint32_t to = graph_.other_end(edge, vertex);
                const double there = distance + graph_.length(edge);
                if (!(there < tree.distance[to])) continue;
                tree.distance[to] = there, tree.edge[to] = edge;
                front.push({there, to});
            }
        }
    }
    return tree;
}

ClosedLines::ClosedLines(const SurfaceGraph& graph, std::span<const std::uint8_t> barred, Job& job)
    : graph_(graph), barred_(barred) {
    const auto edges = graph.edges();
    const Tree tree = shortest_paths(job);
    if (job.cancelled()) return;
    std::vector<bool> in_tree(edges.size(), false);
    for (const std::uint32_t edge : tree.edge)
        if (edge != kNone) in_tree[edge] = true;
    std::vector<std::pair<double, std::uint32_t>> others; // by the length of the closed line through each
    for (std::uint32_t e = 0; e < edges.size(); ++e) {
        if (in_tree[e]) continue;
        const auto& [a, b] = edges[e].ends;
        others.emplace_back(tree.distance[a] + tree.distance[b] + graph.length(e), e);
    }
    tbb::parallel_sort(others.begin(), others.end(), std::greater<>());
    DisjointSets joined(graph.mesh().triangles.size());
    std::vector<std::uint32_t> of_triangles; // the edges that the tree of triangles crosses
    for (const auto& [length, edge] : others) {
        const auto& [s, t] = edges[edge].triangles;
        (joined.join(s, t) ? of_triangles : edges_).push_back(edge);
    }
    find_crossings(of_triangles);
}

HomologyClass ClosedLines::label(std::size_t row) const {
    if (edges_.size() > kBits) return {splitmix64(2 * row), splitmix64(2 * row + 1)};
    HomologyClass bits{};
    bits[row / 64] = std::uint64_t{1} << row % 64;
    return bits;
}

// The row of a remaining edge runs along the tree of triangles from one side of the edge to the other. It crosses an
// edge of that tree if exactly one of its ends is below the edge.
void ClosedLines::find_crossings(std::span<const std::uint32_t> tree) {
    if (edges_.empty()) return;
    crossings_.resize(graph_.edges().size(), {});
    const std::size_t count = graph_.mesh().triangles.size();
    std::vector<HomologyClass> below(count, HomologyClass{}); // each triangle of the tree
    for (std::size_t row = 0; row < edges_.size(); ++row) {
        crossings_[edges_[row]] = label(row);
        for (const std::uint32_t t : graph_.edges()[edges_[row]].triangles) flip(below[t], label(row));
    }
    std::vector<std::array<std::uint32_t, 3>> beside(count, {kNone, kNone, kNone});
    for (const std::uint32_t edge : tree)
        for (const std::uint32_t t : graph_.edges()[edge].triangles) *std::ranges::find(beside[t], kNone) = edge;
    std::vector<std::uint32_t> up(count, kNone), order;
    std::vector<bool> reached(count, false);
    const auto other_side = [&](std::uint32_t edge, std::uint32_t t) {
        const auto& sides = graph_.edges()[edge].triangles;
        return sides[0] == t ? sides[1] : sides[0];
    };
    for (std::uint32_t first = 0; first < count; ++first) {
        if (reached[first]) continue;
        reached[first] = true;
        order.assign(1, first);
        for (std::size_t n = 0; n < order.size(); ++n)
            for (const std::uint32_t edge : beside[order[n]]) {
                if (edge == kNone || edge == up[order[n]]) continue;
                const std::uint32_t t = other_side(edge, order[n]);
                reached[t] = true, up[t] = edge;
                order.push_back(t);
            }
        for (std::size_t n = order.size() - 1; n > 0; --n) {
            const std::uint32_t t = order[n];
            crossings_[up[t]] = below[t];
            flip(below[other_side(up[t], t)], below[t]);
        }
    }
}

// A vertex that the search has reached.
struct ClosedLines::Known {
    double distance;
    std::uint32_t edge;    // toward the start
    HomologyClass crossed; // class of the path from the start
    bool settled = false;
};

std::vector<ClosedLine> ClosedLines::shortest(std::uint32_t vertex, double longest, std::size_t& visited) const {
    struct Closing {
        double length;
        std::uint32_t edge;
    };
    if (edges_.empty() || is_barred(vertex)) return {};
    std::map<HomologyClass, Closing> classes;
    KnownVertices known;
    known.try_emplace(vertex, Known{0.0, kNone, HomologyClass{}});
    Front front;
    front.push({0.0, vertex});
    while (!front.empty()) {
        const auto [distance, at] = front.top();
        front.pop();
        if (2.0 * distance > longest) break;
        Known& here = known.at(at);
        if (here.settled) continue;
        here.settled = true;
        for (const std::uint32_t edge : graph_.edges_at(at)) {
            if (edge == here.edge) continue;
            const std::uint32_t to = graph_.other_end(edge, at);
            if (is_barred(to)) continue;
            HomologyClass there = here.crossed;
            flip(there, crossings_[edge]);
            const double along = distance + graph_.length(edge);
            const auto [entry, fresh] = known.try_emplace(to, Known{along, edge, there});
            Known& other = entry->second;
            if (fresh || (!other.settled && along < other.distance)) {
                other = {along, edge, there};
                front.push({along, to});
            } else if (const double length = along + other.distance; other.settled && length <= longest) {
                flip(there, other.crossed);
                if (!any(there)) continue;
                const auto [shortest, first] = classes.try_emplace(there, Closing{length, edge});
                if (!first && length < shortest->second.length) shortest->second = {length, edge};
            }
        }
    }
    visited += known.size();
    std::vector<ClosedLine> lines;
    for (const auto& [homology, closing] : classes) {
        lines.push_back(closed(known, vertex, closing.edge));
        lines.back().homology = homology;
    }
    std::ranges::stable_sort(lines, {}, &ClosedLine::length);
    return lines;
}

// The line that an edge closes, without the common beginning of its two paths from the start.
ClosedLine ClosedLines::closed(const KnownVertices& known, std::uint32_t start, std::uint32_t edge) const {
    std::array<std::vector<std::uint32_t>, 2> ways; // from the start to the edge's ends
    for (std::size_t side = 0; side < 2; ++side) {
        for (std::uint32_t at = graph_.edges()[edge].ends[side];; at = graph_.other_end(known.at(at).edge, at)) {
            ways[side].push_back(at);
            if (at == start) break;
        }
        std::ranges::reverse(ways[side]);
    }
    const auto [first, second] = std::ranges::mismatch(ways[0], ways[1]);
    ClosedLine line;
    line.vertices.assign(first - 1, ways[0].end());
    line.vertices.insert(line.vertices.end(), ways[1].rbegin(), std::make_reverse_iterator(second));
    const auto position = [&](std::size_t n) {
        return glm::dvec3(graph_.mesh().positions[line.vertices[n % line.vertices.size()]]);
    };
    for (std::size_t n = 0; n < line.vertices.size(); ++n) line.length += glm::distance(position(n), position(n + 1));
    return line;
}

} // namespace ramus::mesh
