#include "core/mesh/loops/surface_parts.h"

#include "core/base/disjoint_sets.h"
#include "core/base/numbers_where.h"
#include "core/base/sort_unique.h"
#include "core/mesh/loops/biconnected.h"

#include <algorithm>
#include <iterator>
#include <oneapi/tbb/parallel_for.h>
#include <unordered_map>
#include <utility>
#include <vector>

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

using BorderEdge = std::pair<std::uint32_t, std::uint32_t>; // vertices, in the order of the part's triangle

// The directed edges of triangles near whose opposite edge belongs to none of these, ascending. `in_rest`, by vertex: 0
// if all triangles there are near.
LargeArray<BorderEdge> border_of(const TriangleMesh& mesh, std::span<const std::uint32_t> near,
                                 std::span<const std::uint8_t> in_rest) {
    LargeArray<BorderEdge> edges(mesh.memory()), border(mesh.memory());
    for (const std::uint32_t n : near)
        for (int corner = 0; corner < 3; ++corner) {
            const std::uint32_t from = mesh.triangles[n][corner], to = mesh.triangles[n][(corner + 1) % 3];
            if (in_rest[from] != 0 && in_rest[to] != 0) edges.emplace_back(from, to);
        }
    std::ranges::sort(edges);
    std::ranges::copy_if(edges, std::back_inserter(border), [&](const BorderEdge& edge) {
        return !std::ranges::binary_search(edges, BorderEdge(edge.second, edge.first));
    });
    return border;
}

// Adds all triangles at vertices that occur in borders more than once. Returns whether there were any.
bool widen(const TriangleMesh& mesh, const TriangleBoxes& boxes, std::span<const BorderEdge> border,
           LargeArray<std::uint32_t>& triangles) {
    const std::size_t before = triangles.size();
    for (std::size_t n = 1; n < border.size(); ++n) {
        const std::uint32_t vertex = border[n].first;
        if (vertex != border[n - 1].first) continue;
        boxes.for_each_in({mesh.positions[vertex], mesh.positions[vertex]}, [&](std::uint32_t triangle) {
            const glm::uvec3& t = mesh.triangles[triangle];
            if (t.x == vertex || t.y == vertex || t.z == vertex) triangles.push_back(triangle);
        });
    }
    if (triangles.size() == before) return false;
    sort_unique(triangles);
    return triangles.size() > before;
}

// Calls call(triangle) for each triangle that is not near.
template <class Call> void for_each_far(std::size_t triangles, std::span<const std::uint32_t> near, const Call& call) {
    auto next = near.begin();
    for (std::uint32_t n = 0; n < triangles; ++n) {
        if (next == near.end() || *next != n)
            call(n);
        else
            ++next;
    }
}

// The border of `near`, after triangles are added such that no vertex occurs in it twice.
LargeArray<BorderEdge> single_border(const TriangleMesh& mesh, const TriangleBoxes& boxes,
                                     LargeArray<std::uint32_t>& near) {
    LargeArray<std::uint8_t> in_rest(mesh.positions.size(), 0, mesh.memory());
    for_each_far(mesh.triangles.size(), near, [&](std::uint32_t n) {
        for (int corner = 0; corner < 3; ++corner) in_rest[mesh.triangles[n][corner]] = 1;
    });
    LargeArray<BorderEdge> border(mesh.memory());
    do border = border_of(mesh, near, in_rest);
    while (widen(mesh, boxes, border, near));
    return border;
}

// A surface as sets of vertices that triangles of one kind connect: those near, or the rest. A vertex of the border has
// a second number for the rest, since all triangles of the rest at such a vertex are adjacent.
class Division {
public:
    Division(const TriangleMesh& mesh, std::span<const std::uint32_t> near, std::span<const BorderEdge> border)
        : mesh_(mesh), near_(near), border_(border), at_near_(mesh.positions.size(), 0, mesh.memory()),
          sets_(mesh.positions.size() + border.size(), mesh.memory()) {
        for (const std::uint32_t n : near) {
            const glm::uvec3& t = mesh_.triangles[n];
            sets_.join(t.x, t.y), sets_.join(t.x, t.z);
            for (int corner = 0; corner < 3; ++corner) at_near_[t[corner]] = 1;
        }
        for_each_of_rest([&](std::uint32_t, const glm::uvec3& t) { sets_.join(t.x, t.y), sets_.join(t.x, t.z); });
    }

    [[nodiscard]] std::size_t numbers() const { return mesh_.positions.size() + border_.size(); } // of vertices
    [[nodiscard]] std::size_t sets() const { return sets_.count(); }
    [[nodiscard]] std::uint32_t set_of(std::uint32_t number) { return sets_.find(number); }
    // Whether a number is that of a vertex in the rest.
    [[nodiscard]] bool in_rest(std::uint32_t number) const {
        return number >= at_near_.size() || at_near_[number] == 0;
    }
    // The edge of the border that begins at a vertex; their number if none does.
    [[nodiscard]] std::uint32_t edge_at(std::uint32_t vertex) const {
        const auto edge = std::ranges::lower_bound(border_, vertex, {}, &BorderEdge::first);
        return static_cast<std::uint32_t>(edge - border_.begin());
    }
    // The second number of a vertex of the border.
    [[nodiscard]] std::uint32_t beyond(std::uint32_t vertex) const {
        return static_cast<std::uint32_t>(mesh_.positions.size()) + edge_at(vertex);
    }
    // Calls call(triangle, the numbers of its corners) for each triangle of the rest.
    template <class Call> void for_each_of_rest(const Call& call) const {
        const auto number = [&](std::uint32_t vertex) { return at_near_[vertex] == 0 ? vertex : beyond(vertex); };
        for_each_far(mesh_.triangles.size(), near_, [&](std::uint32_t n) {
            const glm::uvec3& t = mesh_.triangles[n];
            if ((at_near_[t.x] | at_near_[t.y] | at_near_[t.z]) == 0) // most
                call(n, t);
            else
                call(n, glm::uvec3(number(t.x), number(t.y), number(t.z)));
        });
    }
    void join_both_sides() {
        for (const BorderEdge& edge : border_) sets_.join(edge.first, beyond(edge.first));
    }

private:
    const TriangleMesh& mesh_;
    std::span<const std::uint32_t> near_;
    std::span<const BorderEdge> border_;
    LargeArray<std::uint8_t> at_near_; // by vertex: whether it has triangles near
    DisjointSets sets_;
};

// Numbers sets consecutively, in the order of first use.
class Numbers {
public:
    std::uint32_t of(std::uint32_t set) {
        return numbers_.try_emplace(set, static_cast<std::uint32_t>(numbers_.size())).first->second;
    }
    [[nodiscard]] std::size_t count() const { return numbers_.size(); }

private:
    std::unordered_map<std::uint32_t, std::uint32_t> numbers_; // sets are far fewer than vertices
};

// A closed line of the border.
struct Line {
    std::uint32_t part = 0, first = 0, count = 0; // of its vertices
};

// The closed lines of the border, and their vertices.
LargeArray<Line> lines_of(std::span<const BorderEdge> border, Division& division, Numbers& numbers,
                          LargeArray<std::uint32_t>& vertices) {
    LargeArray<Line> lines(vertices.get_allocator());
    LargeArray<std::uint8_t> taken(border.size(), 0, vertices.get_allocator());
    vertices.reserve(border.size());
    for (std::uint32_t n = 0; n < border.size(); ++n) {
        const auto first = static_cast<std::uint32_t>(vertices.size());
        for (std::uint32_t next = n; next < border.size() && taken[next] == 0;
             next = division.edge_at(vertices.back())) {
            taken[next] = 1;
            vertices.push_back(border[next].second);
        }
        if (const auto count = static_cast<std::uint32_t>(vertices.size()) - first; count > 0)
            lines.push_back({numbers.of(division.set_of(border[n].first)), first, count});
    }
    return lines;
}

// The triangles of the pieces of the rest that contain loops, ascending. For each piece, with each border closed by a
// point: 2 (V - E + F) = 4 - 4 loops, where 2 E = 3 F + the edges of its borders.
LargeArray<std::uint32_t> loops_of_rest(Division& division, std::span<const PartBorder> borders,
                                        const LargeAllocator<std::byte>& memory) {
    LargeArray<std::int32_t> twice(division.numbers(), 0, memory);
    for (std::uint32_t n = 0; n < twice.size(); ++n)
        if (division.in_rest(n)) twice[division.set_of(n)] += 2;
    division.for_each_of_rest([&](std::uint32_t, const glm::uvec3& t) { --twice[division.set_of(t.x)]; });
    for (const PartBorder& border : borders)
        twice[division.set_of(division.beyond(border.vertices.front()))] +=
            2 - static_cast<std::int32_t>(border.vertices.size());
    LargeArray<std::uint32_t> found(memory);
    division.for_each_of_rest([&](std::uint32_t n, const glm::uvec3& t) {
        if (twice[division.set_of(t.x)] < 4) found.push_back(n);
    });
    return found;
}

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

SurfaceParts::SurfaceParts(const TriangleMesh& mesh, const TriangleBoxes& boxes, LargeArray<std::uint32_t> near,
                           Rest rest)
    : border_vertices_(mesh.memory()), parts_(mesh.memory()), rest_with_loops_(mesh.memory()) {
    const LargeArray<BorderEdge> border = single_border(mesh, boxes, near);
    Division division(mesh, near, border);
    Numbers numbers; // of parts, then of the pieces of the rest at them
    for (const std::uint32_t n : near) numbers.of(division.set_of(mesh.triangles[n].x));
    parts_.assign(numbers.count(), SurfacePart());
    triangles_ = Grouped<std::uint32_t>(
        parts_.size(),
        [&](const auto& put) {
            for (const std::uint32_t n : near) put(numbers.of(division.set_of(mesh.triangles[n].x)), n);
        },
        mesh.memory());
    const LargeArray<Line> lines = lines_of(border, division, numbers, border_vertices_);
    LargeArray<GraphEdge> graph(mesh.memory()); // of parts and pieces, which are connected by borders
    borders_ = Grouped<PartBorder>(
        parts_.size(),
        [&](const auto& put) {
            for (const Line& line : lines)
                put(line.part, PartBorder{std::span(border_vertices_).subspan(line.first, line.count), 0});
        },
        mesh.memory());
    for (std::uint32_t part = 0; part < parts_.size(); ++part)
        for (const PartBorder& one : borders_.of(part))
            graph.push_back({part, numbers.of(division.set_of(division.beyond(one.vertices.front())))});
    const LargeArray<std::uint32_t> components = biconnected_components(graph, numbers.count(), mesh.memory());
    tbb::parallel_for(std::uint32_t{0}, static_cast<std::uint32_t>(parts_.size()), [&](std::uint32_t n) {
        SurfacePart& part = parts_[n];
        part.triangles = triangles_.of(n), part.borders = borders_.of(n);
        std::uint32_t at = borders_.first(n);
        for (PartBorder& one : borders_.of(n)) {
            const std::uint32_t component = components[at++];
            part.has_loops = part.has_loops || component != kOnNoCycle;
            one.connected = component != kOnNoCycle ? component : static_cast<std::uint32_t>(graph.size()) + at;
        }
        part.has_loops = part.has_loops || loops_within(mesh, part) > 0;
    });
    if (rest == Rest::kLoops) rest_with_loops_ = loops_of_rest(division, borders_.all(), mesh.memory());
    division.join_both_sides();
    of_surface_.pieces = static_cast<std::int64_t>(division.sets());
    const auto characteristic = // of Euler: three edges for two triangles
        static_cast<std::int64_t>(mesh.positions.size()) - static_cast<std::int64_t>(mesh.triangles.size() / 2);
    of_surface_.loops = of_surface_.pieces - characteristic / 2;
}

LargeArray<std::uint32_t> triangles_at(const TriangleMesh& mesh, const TriangleBoxes& boxes,
                                       std::span<const Bounds<glm::vec3>> places) {
    if (places.empty()) return {};
    LargeArray<std::uint8_t> is_at(mesh.triangles.size(), 0, mesh.memory());
    const auto box_of_place = [&](std::size_t n) {
        const glm::vec3 beside = kBeside * places[n].size();
        return TriangleBox{places[n].least - beside, places[n].most + beside};
    };
    boxes.mark_in(places.size(), box_of_place, is_at, std::uint8_t{1});
    return numbers_where(
        is_at.size(), [&](std::uint32_t n) { return is_at[n] != 0; }, mesh.memory());
}

LargeArray<std::uint32_t> triangles_around(const TriangleMesh& mesh, const TriangleBoxes& boxes,
                                           std::span<const std::uint32_t> triangles) {
    LargeArray<std::uint8_t> is_around(mesh.triangles.size(), 0, mesh.memory()); // most are found many times
    const auto box_around = [&](std::size_t n) {
        const TriangleBox box = boxes.box(triangles[n]);
        const glm::vec3 size = box.size();
        const float reach = kReach * std::max({size.x, size.y, size.z});
        return TriangleBox{box.least - reach, box.most + reach};
    };
    boxes.mark_in(triangles.size(), box_around, is_around, std::uint8_t{1});
    return numbers_where(
        is_around.size(), [&](std::uint32_t n) { return is_around[n] != 0; }, mesh.memory());
}

LargeArray<std::uint32_t> triangles_between_branches(const TriangleMesh& mesh) {
    if (mesh.branches.empty()) return {};
    const auto is_between = [&](std::uint32_t n) {
        const glm::uvec3& t = mesh.triangles[n];
        const std::int32_t first = mesh.branches[t.x];
        return first != mesh.branches[t.y] || first != mesh.branches[t.z];
    };
    return numbers_where(mesh.triangles.size(), is_between, mesh.memory());
}

LargeArray<std::uint32_t> foreign_triangles(const TriangleMesh& mesh, const tree::PreparedTree& tree,
                                            std::span<const std::uint32_t> between_branches) {
    const Neighbours neighbours(tree);
    LargeArray<std::uint32_t> foreign(mesh.memory());
    std::ranges::copy_if(between_branches, std::back_inserter(foreign), [&](std::uint32_t n) {
        const glm::uvec3& t = mesh.triangles[n];
        const std::int32_t a = mesh.branches[t.x], b = mesh.branches[t.y], c = mesh.branches[t.z];
        return !neighbours.meet(a, b) || !neighbours.meet(b, c) || !neighbours.meet(a, c);
    });
    return foreign;
}

} // namespace ramus::mesh
