// The marching cubes table: the triangles in a cell of eight voxel centres, for all 256 cases of inside and outside
// corners. Derived at compile time from three rules:
//
//   1. On a face of the cell, one line separates each run of outside corners from the rest. So inside corners on a
//      diagonal of a face are connected, and both cells that share the face agree.
//   2. The lines of the six faces form closed loops, and each loop is filled with triangles. No edge inside a cell
//      connects two vertices of the same face: the neighbouring cell might have it too, and four triangles would share
//      it.
//   3. If only two opposite corners are inside, a tube connects their two loops instead.
//
// Rules 1 and 3 implement (26, 6)-connectivity of digital topology: inside voxels are connected by faces, edges and
// corners, outside voxels by faces.
// Guaranteed: every mesh made from the table is closed, and each vertex has one ring of triangles, because one loop
// passes through it in each of the four cells around its edge.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace ramus::volume {

// Corner c of a cell is at (c & 1, c >> 1 & 1, c >> 2 & 1); bit c of a case is set if it is inside. Edge
// 4 * axis + u + 2 * v is parallel to `axis` and begins at the corner with coordinates u, v along the other two axes,
// the lower axis first.
struct CellEdge {
    int axis, from, to; // corners
};
constexpr CellEdge cell_edge(int edge) {
    const int axis = edge / 4;
    const int first = axis == 0 ? 1 : 0;
    const int second = axis == 2 ? 1 : 2;
    const int from = ((edge & 1) << first) | ((edge >> 1 & 1) << second);
    return {axis, from, from | (1 << axis)};
}

struct CellCase {
    static constexpr int kMostTriangles = 6;
    std::uint8_t triangles = 0;
    std::uint16_t edges = 0; // bit e: the surface cuts edge e
    std::array<std::uint8_t, 3 * kMostTriangles>
        corners{}; // cut edges of the triangles, counter-clockwise from outside
};

namespace table {

constexpr int edge_between(int a, int b) {
    for (int edge = 0; edge < 12; ++edge) {
        const CellEdge ends = cell_edge(edge);
        if ((ends.from == a && ends.to == b) || (ends.from == b && ends.to == a)) return edge;
    }
    return -1;
}

// The two faces of an edge, as bits 2 * axis + side.
constexpr int faces_of(int edge) {
    const CellEdge ends = cell_edge(edge);
    int faces = 0;
    for (int axis = 0; axis < 3; ++axis)
        if (axis != ends.axis) faces |= 1 << (2 * axis + (ends.from >> axis & 1));
    return faces;
}

// The squared distance of the middles of two edges, in half cells.
constexpr int distance2(int edge_a, int edge_b) {
    int sum = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const auto twice = [&](int edge) {
            const CellEdge ends = cell_edge(edge);
            return (ends.from >> axis & 1) + (ends.to >> axis & 1);
        };
        const int d = twice(edge_a) - twice(edge_b);
        sum += d * d;
    }
    return sum;
}

// For each cut edge the next one on its loop, counter-clockwise from outside (rule 1). -1: not cut.
constexpr std::array<int, 12> next_edges(int inside) {
    std::array<int, 12> next{};
    next.fill(-1);
    for (int axis = 0; axis < 3; ++axis) {
        for (int side = 0; side < 2; ++side) {
            const int u = 1 << ((axis + 1) % 3);
            const int v = 1 << ((axis + 2) % 3);
            const int base = side << axis;
            // The face's corners, counter-clockwise seen from outside the cell.
            const std::array<int, 4> ring = side == 1 ? std::array<int, 4>{base, base | u, base | u | v, base | v}
                                                      : std::array<int, 4>{base, base | v, base | u | v, base | u};
            for (std::size_t n = 0; n < 4; ++n) {
                const auto is_inside = [&](std::size_t at) { return (inside >> ring[at % 4] & 1) != 0; };
                if (!is_inside(n) || is_inside(n + 1)) continue;
                std::size_t end = n + 1; // of the run of outside corners
                while (!is_inside(end + 1)) ++end;
                next[static_cast<std::size_t>(edge_between(ring[end % 4], ring[(end + 1) % 4]))] =
                    edge_between(ring[n], ring[(n + 1) % 4]);
            }
        }
    }
    return next;
}

struct Loop {
    std::array<int, 12> edges{};
    int length = 0;
};

constexpr void add_triangle(CellCase& cell, int a, int b, int c) {
    std::size_t at = 3 * std::size_t{cell.triangles++};
    for (const int edge : {a, b, c}) cell.corners[at++] = static_cast<std::uint8_t>(edge);
}

// The triangulation of a loop with the shortest inner edges among those that keep rule 2, by dynamic programming.
class Cutting {
public:
    constexpr explicit Cutting(const Loop& loop) : loop_(loop) {
        for (int span = 2; span < loop.length; ++span)
            for (int a = 0; a + span < loop.length; ++a) solve(a, a + span);
    }
    [[nodiscard]] constexpr bool possible() const { return cost(0, loop_.length - 1) < kNever; }
    constexpr void put(CellCase& cell) const { put(cell, 0, loop_.length - 1); }

private:
    static constexpr int kNever = 1 << 20;
    struct Best {
        int cost = 0, middle = -1;
    };
    [[nodiscard]] constexpr int edge(int n) const { return loop_.edges[static_cast<std::size_t>(n)]; }
    [[nodiscard]] constexpr const Best& best(int a, int b) const { return best_[static_cast<std::size_t>(12 * a + b)]; }
    [[nodiscard]] constexpr int cost(int a, int b) const { return best(a, b).cost; }
    constexpr void solve(int a, int b) {
        Best& result = best_[static_cast<std::size_t>(12 * a + b)];
        result.cost = kNever;
        const bool is_cut = !(a == 0 && b == loop_.length - 1);
        if (is_cut && (faces_of(edge(a)) & faces_of(edge(b))) != 0) return;
        const int own = is_cut ? distance2(edge(a), edge(b)) : 0;
        for (int middle = a + 1; middle < b; ++middle) {
            const int sum = own + cost(a, middle) + cost(middle, b);
            if (sum < result.cost) result = {sum, middle};
        }
    }
    constexpr void put(CellCase& cell, int a, int b) const {
        if (b - a < 2) return;
        const int middle = best(a, b).middle;
        put(cell, a, middle);
        add_triangle(cell, edge(a), edge(middle), edge(b));
        put(cell, middle, b);
    }

    Loop loop_;
    std::array<Best, 144> best_{};
};

// Rule 3: each edge of a loop forms a triangle with a vertex of the other loop: the one on the third axis.
constexpr void put_tube(CellCase& cell, const Loop& one, const Loop& other) {
    for (const auto& [from, to] : {std::pair{&one, &other}, std::pair{&other, &one}}) {
        for (std::size_t n = 0; n < 3; ++n) {
            const int a = from->edges[n];
            const int b = from->edges[(n + 1) % 3];
            int across = -1;
            for (std::size_t m = 0; m < 3; ++m)
                if (to->edges[m] / 4 != a / 4 && to->edges[m] / 4 != b / 4) across = to->edges[m];
            add_triangle(cell, a, b, across);
        }
    }
}

constexpr CellCase make_case(int inside) {
    CellCase cell;
    const std::array<int, 12> next = next_edges(inside);
    std::array<Loop, 4> loops{};
    std::size_t count = 0;
    for (int first = 0; first < 12; ++first) {
        if (next[static_cast<std::size_t>(first)] < 0 || (cell.edges >> first & 1) != 0) continue;
        Loop& loop = loops[count++];
        for (int edge = first; (cell.edges >> edge & 1) == 0; edge = next[static_cast<std::size_t>(edge)]) {
            cell.edges = static_cast<std::uint16_t>(cell.edges | 1 << edge);
            loop.edges[static_cast<std::size_t>(loop.length++)] = edge;
        }
    }
    for (int corner = 0; corner < 4; ++corner) {
        if (inside != ((1 << corner) | (1 << (7 - corner)))) continue;
        put_tube(cell, loops[0], loops[1]);
        return cell;
    }
    for (std::size_t n = 0; n < count; ++n) {
        const Cutting cutting(loops[n]);
        if (!cutting.possible()) throw "a loop cannot be cut into triangles"; // does not compile
        cutting.put(cell);
    }
    return cell;
}

constexpr std::array<CellCase, 256> make_cases() {
    std::array<CellCase, 256> cases{};
    for (int inside = 0; inside < 256; ++inside) cases[static_cast<std::size_t>(inside)] = make_case(inside);
    return cases;
}

} // namespace table

inline constexpr std::array<CellCase, 256> kCellCases = table::make_cases();

} // namespace ramus::volume
