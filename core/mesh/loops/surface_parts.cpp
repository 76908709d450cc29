#include "core/mesh/loops/surface_parts.h"

#include "core/base/disjoint_sets.h"
#include "core/base/large_array.h"
#include "core/base/lists_by_thread.h"
#include "core/base/sort_unique.h"

#include <algorithm>
#include <boost/graph/adjacency_list.hpp>
#include <boost/graph/biconnected_components.hpp>
#include <iterator>
#include <numeric>
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>
#include <unordered_map>
#include <utility>

namespace ramus::mesh {

namespace {

constexpr float kBeside = 0.5F; // how far the triangles near a place reach beyond it, in sizes of the place
constexpr float kReach = 4.0F;  // how far the triangles around a triangle reach beyond it, in its longest side

// Pairs of branches of the file with a common point, the lower branch first, ascending.
class Neighbours {
public:
    explicit Neighbours(const tree::PreparedTree& tree) {
        std::vector<std::pair<std::uint32_t, int>> at; // a point, and a branch that contains it
        std::size_t segment = 0;
        for (const tree::Branch& branch : tree.tree.branches)
            for (std::size_t i = 1; i < branch.points.size(); ++i, ++segment)
                for (const std::uint32_t point : {branch.points[i - 1], branch.points[i]})
                    at.emplace_back(point, tree.segment_source[segment]);
        sort_unique(at);
        for (std::size_t first = 0, end = 0; first < at.size(); first = end) {
            while (end < at.size() && at[end].first == at[first].first) ++end;
            for (std::size_t a = first; a < end; ++a)
                for (std::size_t b = a + 1; b < end; ++b) pairs_.emplace_back(at[a].second, at[b].second);
        }
        sort_unique(pairs_);
    }
    [[nodiscard]] bool meet(int a, int b) const {
        return a == b || std::ranges::binary_search(pairs_, std::pair(std::min(a, b), std::max(a, b)));
    }

private:
    std::vector<std::pair<int, int>> pairs_;
};

// The directed edges of the triangles whose opposite edge belongs to none of them, ascending.
std::vector<BorderEdge> border_of(const TriangleMesh& mesh, std::span<const std::uint32_t> triangles) {
    LargeArray<BorderEdge> edges(mesh.memory());
    edges.reserve(3 * triangles.size());
    for (const std::uint32_t n : triangles)
        for (int corner = 0; corner < 3; ++corner)
            edges.emplace_back(mesh.triangles[n][corner], mesh.triangles[n][(corner + 1) % 3]);
    std::ranges::sort(edges);
    std::vector<BorderEdge> border;
    std::ranges::copy_if(edges, std::back_inserter(border), [&](const BorderEdge& edge) {
        return !std::ranges::binary_search(edges, BorderEdge(edge.second, edge.first));
    });
    return border;
}

// Adds all triangles at vertices that occur in borders more than once. Returns whether there were any.
bool widen(const TriangleMesh& mesh, const TriangleBoxes& boxes, std::span<const BorderEdge> border,
           std::vector<std::uint32_t>& triangles) {
    const std::size_t before = triangles.size();
    for (std::size_t n = 1; n < border.size(); ++n) {
        const std::uint32_t vertex = border[n].first;
        if (vertex != border[n - 1].first) continue;
        boxes.for_each_in({mesh.positions[vertex], mesh.positions[vertex]}, [&](std::uint32_t triangle) {
            const glm::uvec3& t = mesh.triangles[triangle];
            if (t.x == vertex || t.y == vertex || t.z == vertex) triangles.push_back(triangle);
        });
    }
    sort_unique(triangles);
    return triangles.size() > before;
}

// Numbers vertices consecutively, in the order of first use.
class Numbers {
public:
    std::uint32_t of(std::uint32_t vertex) {
        return numbers_.try_emplace(vertex, static_cast<std::uint32_t>(numbers_.size())).first->second;
    }
    [[nodiscard]] std::size_t size() const { return numbers_.size(); }

private:
    std::unordered_map<std::uint32_t, std::uint32_t> numbers_;
};

// The loops within a part, by Euler's formula: with each border closed by a point, V - E + F = 2 - 2 loops.
std::int64_t loops_within(const TriangleMesh& mesh, const SurfacePart& part) {
    std::vector<std::uint32_t> vertices;
    for (const std::uint32_t n : part.triangles)
        for (int corner = 0; corner < 3; ++corner) vertices.push_back(mesh.triangles[n][corner]);
    sort_unique(vertices);
    std::size_t sides = 3 * part.triangles.size();
    for (const PartBorder& border : part.borders) sides += border.vertices.size();
    const auto closed = static_cast<std::int64_t>(vertices.size() + part.triangles.size() + part.borders.size()) -
                        static_cast<std::int64_t>(sides / 2);
    return (2 - closed) / 2;
}

} // namespace

SurfaceParts::SurfaceParts(const TriangleMesh& mesh, const TriangleBoxes& boxes, std::vector<std::uint32_t> near,
                           Rest rest)
    : mesh_(mesh) {
    std::vector<BorderEdge> border;
    do border = border_of(mesh, near);
    while (widen(mesh, boxes, border, near));
    take_parts(near, border);
    find_rest(near, border, rest);
}

void SurfaceParts::take_parts(std::span<const std::uint32_t> near, std::span<const BorderEdge> border) {
    Numbers here;
    DisjointSets sets(3 * near.size());
    for (const std::uint32_t n : near) {
        const glm::uvec3& t = mesh_.triangles[n];
        sets.join(here.of(t.x), here.of(t.y)), sets.join(here.of(t.x), here.of(t.z));
    }
    std::unordered_map<std::uint32_t, std::size_t> part_of; // by the vertex that stands for it
    for (const std::uint32_t n : near) {
        const auto [part, fresh] = part_of.try_emplace(sets.find(here.of(mesh_.triangles[n].x)), parts_.size());
        if (fresh) parts_.emplace_back();
        parts_[part->second].triangles.push_back(n);
    }
    std::unordered_map<std::uint32_t, std::uint32_t> after(border.begin(), border.end());
    for (const BorderEdge& link : border) {
        PartBorder one;
        for (auto next = after.find(link.first); next != after.end(); next = after.find(one.vertices.back())) {
            one.vertices.push_back(next->second);
            after.erase(next);
        }
        if (!one.vertices.empty()) parts_[part_of.at(sets.find(here.of(link.first)))].borders.push_back(std::move(one));
    }
}

// Finds the piece of the rest beyond each border. Triangles of the rest are connected by common vertices. A vertex of a
// border gets a second number for the rest, since all triangles of the rest at such a vertex are adjacent.
void SurfaceParts::find_rest(std::span<const std::uint32_t> near, std::span<const BorderEdge> border, Rest rest) {
    LargeArray<std::uint8_t> touched(mesh_.positions.size(), 0,
                                     mesh_.memory()); // by vertex: whether it has triangles in `near`
    std::size_t of_parts = 0;
    for (const std::uint32_t n : near)
        for (int corner = 0; corner < 3; ++corner)
            of_parts += std::exchange(touched[mesh_.triangles[n][corner]], std::uint8_t{1}) == 0 ? 1 : 0;
    std::unordered_map<std::uint32_t, std::uint32_t> beyond; // by vertex of a border: its number in the rest
    for (const BorderEdge& link : border)
        beyond.emplace(link.first, static_cast<std::uint32_t>(mesh_.positions.size() + beyond.size()));
    DisjointSets sets(mesh_.positions.size() + beyond.size(), mesh_.memory());
    const auto number = [&](std::uint32_t vertex) { return touched[vertex] == 0 ? vertex : beyond.at(vertex); };
    // Calls call(triangle, the numbers of its corners) for each triangle of the rest.
    const auto for_each_of_rest = [&](const auto& call) {
        auto next = near.begin();
        for (std::uint32_t n = 0; n < mesh_.triangles.size(); ++n) {
            const glm::uvec3& t = mesh_.triangles[n];
            if ((touched[t.x] | touched[t.y] | touched[t.z]) == 0) { // most
                call(n, t);
                continue;
            }
            while (next != near.end() && *next < n) ++next;
            if (next == near.end() || *next != n) call(n, glm::uvec3(number(t.x), number(t.y), number(t.z)));
        }
    };
    for_each_of_rest([&](std::uint32_t, const glm::uvec3& t) { sets.join(t.x, t.y), sets.join(t.x, t.z); });
    std::vector<std::uint32_t> pieces; // of the rest, beyond all borders of all parts
    for (const SurfacePart& part : parts_)
        for (const PartBorder& one : part.borders) pieces.push_back(sets.find(beyond.at(one.vertices.front())));
    if (rest == Rest::kLoops) {
        // For each piece, with each border closed by a point: 2 (V - E + F) = 4 - 4 loops, where 2 E = 3 F + the edges
        // of its borders.
        LargeArray<std::int32_t> twice(mesh_.positions.size() + beyond.size(), 0, mesh_.memory());
        for (std::uint32_t n = 0; n < twice.size(); ++n)
            if (n >= touched.size() || touched[n] == 0) twice[sets.find(n)] += 2;
        for_each_of_rest([&](std::uint32_t, const glm::uvec3& t) { --twice[sets.find(t.x)]; });
        auto piece = pieces.begin();
        for (const SurfacePart& part : parts_)
            for (const PartBorder& one : part.borders)
                twice[*piece++] += 2 - static_cast<std::int32_t>(one.vertices.size());
        for_each_of_rest([&](std::uint32_t n, const glm::uvec3& t) {
            if (twice[sets.find(t.x)] < 4) rest_with_loops_.push_back(n);
        });
    }
    find_loops(pieces, sets.count() - of_parts);
}

// Builds the graph of parts, pieces of the rest and borders. Each border is a node, since a part and a piece may have
// several common borders. `rest`: the number of pieces of the rest.
void SurfaceParts::find_loops(std::span<const std::uint32_t> beyond, std::size_t rest) {
    using Graph = boost::adjacency_list<boost::vecS, boost::vecS, boost::undirectedS, boost::no_property,
                                        boost::property<boost::edge_index_t, std::size_t>>;
    Numbers pieces;
    for (const std::uint32_t piece : beyond) pieces.of(piece);
    const std::size_t first_piece = parts_.size() + beyond.size();
    Graph graph(first_piece + pieces.size());
    DisjointSets together(first_piece + pieces.size());
    std::size_t border = 0;
    for (std::size_t part = 0; part < parts_.size(); ++part)
        for (std::size_t n = 0; n < parts_[part].borders.size(); ++n, ++border) {
            const std::size_t node = parts_.size() + border, piece = first_piece + pieces.of(beyond[border]);
            boost::add_edge(part, node, 2 * border, graph);
            boost::add_edge(node, piece, 2 * border + 1, graph);
            together.join(static_cast<std::uint32_t>(part), static_cast<std::uint32_t>(node));
            together.join(static_cast<std::uint32_t>(node), static_cast<std::uint32_t>(piece));
        }
    std::vector<std::size_t> component(2 * beyond.size(), 0);
    boost::biconnected_components(
        graph, boost::make_iterator_property_map(component.begin(), boost::get(boost::edge_index, graph)));
    border = 0;
    for (SurfacePart& part : parts_) {
        for (PartBorder& one : part.borders) {
            one.connected = static_cast<std::uint32_t>(component[2 * border]);
            part.has_loops = part.has_loops || component[2 * border] == component[2 * border + 1];
            ++border;
        }
        part.has_loops = part.has_loops || loops_within(mesh_, part) > 0;
    }
    of_surface_.pieces = static_cast<std::int64_t>(together.count() + rest - pieces.size());
    const auto characteristic = // of Euler: three edges for two triangles
        static_cast<std::int64_t>(mesh_.positions.size()) - static_cast<std::int64_t>(mesh_.triangles.size() / 2);
    of_surface_.loops = of_surface_.pieces - characteristic / 2;
}

SurfacePart whole_part(const TriangleMesh& mesh) {
    SurfacePart whole{std::vector<std::uint32_t>(mesh.triangles.size()), {}, true};
    std::iota(whole.triangles.begin(), whole.triangles.end(), 0U);
    return whole;
}

std::vector<std::uint32_t> triangles_at(const TriangleBoxes& boxes, std::span<const Bounds<glm::vec3>> places) {
    std::vector<std::uint32_t> found;
    for (const Bounds<glm::vec3>& place : places) {
        const glm::vec3 beside = kBeside * place.size();
        boxes.for_each_in({place.least - beside, place.most + beside},
                          [&](std::uint32_t triangle) { found.push_back(triangle); });
    }
    sort_unique(found);
    return found;
}

std::vector<std::uint32_t> triangles_around(const TriangleMesh& mesh, const TriangleBoxes& boxes,
                                            std::span<const std::uint32_t> triangles) {
    LargeArray<std::uint8_t> is_around(mesh.triangles.size(), 0, mesh.memory()); // most are found many times
    for (const std::uint32_t n : triangles) {
        const TriangleBox box = boxes.box(n);
        const glm::vec3 size = box.size();
        const float reach = kReach * std::max({size.x, size.y, size.z});
        const TriangleBox around{box.least - reach, box.most + reach};
        boxes.for_each_group_in(around, [&](std::size_t group, const TriangleBox&) {
            boxes.for_each_of(group, [&](std::uint32_t other) {
                if (is_around[other] == 0 && boxes.box(other).meets(around)) is_around[other] = 1;
            });
        });
    }
    std::vector<std::uint32_t> found;
    for (std::uint32_t n = 0; n < is_around.size(); ++n)
        if (is_around[n] != 0) found.push_back(n);
    return found;
}

std::vector<std::uint32_t> triangles_between_branches(const TriangleMesh& mesh) {
    if (mesh.branches.empty()) return {};
    ListsByThread<std::uint32_t> found;
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, mesh.triangles.size()), [&](const auto& range) {
        for (std::size_t n = range.begin(); n < range.end(); ++n) {
            const glm::uvec3& t = mesh.triangles[n];
            const std::int32_t first = mesh.branches[t.x];
            if (first != mesh.branches[t.y] || first != mesh.branches[t.z])
                found.local().push_back(static_cast<std::uint32_t>(n));
        }
    });
    return found.sorted();
}

std::vector<std::uint32_t> foreign_triangles(const TriangleMesh& mesh, const tree::PreparedTree& tree,
                                             std::span<const std::uint32_t> between_branches) {
    const Neighbours neighbours(tree);
    std::vector<std::uint32_t> foreign;
    std::ranges::copy_if(between_branches, std::back_inserter(foreign), [&](std::uint32_t n) {
        const glm::uvec3& t = mesh.triangles[n];
        const std::int32_t a = mesh.branches[t.x], b = mesh.branches[t.y], c = mesh.branches[t.z];
        return !neighbours.meet(a, b) || !neighbours.meet(b, c) || !neighbours.meet(a, c);
    });
    return foreign;
}

} // namespace ramus::mesh
