#include "core/mesh/polygonize/cell_loops.h"

#include <cassert>

namespace ramus::mesh::bricks {

namespace {

struct Point3 {
    int c[3];
};

int index_of(const Point3& p) { return quarter_index(p.c[0], p.c[1], p.c[2]); }

Point3 midpoint(const Point3& a, const Point3& b) {
    return {{(a.c[0] + b.c[0]) / 2, (a.c[1] + b.c[1]) / 2, (a.c[2] + b.c[2]) / 2}};
}

bool is_inside(const CellShape& shape, const Point3& p) {
    return (shape.inside >> (p.c[0] / 2 + 3 * (p.c[1] / 2) + 9 * (p.c[2] / 2)) & 1U) != 0;
}

std::array<EdgeGeometry, 12> make_edges() {
    std::array<EdgeGeometry, 12> edges{};
    for (int axis = 0; axis < 3; ++axis) {
        for (int side = 0; side < 4; ++side) {
            Point3 from{};
            from.c[(axis + 1) % 3] = side & 1;
            from.c[(axis + 2) % 3] = side >> 1;
            Point3 to = from;
            to.c[axis] = 1;
            Point3 mid{{4 * from.c[0], 4 * from.c[1], 4 * from.c[2]}};
            mid.c[axis] = 2;
            const auto corner = [](const Point3& p) {
                return static_cast<std::uint8_t>(p.c[0] + 2 * p.c[1] + 4 * p.c[2]);
            };
            edges[static_cast<std::size_t>(4 * axis + side)] = {corner(from), corner(to),
                                                                static_cast<std::uint8_t>(index_of(mid))};
        }
    }
    return edges;
}

// The ring of points around a minimal face, and the face's centre.
struct Ring {
    int size = 0;
    std::array<Point3, 8> points{};
    Point3 centre{};
    int face = 0;
    bool whole = true;
};

int edge_between(const Point3& a, const Point3& b) {
    for (int axis = 0; axis < 3; ++axis) {
        if (a.c[axis] == b.c[axis]) continue;
        return 4 * axis + (a.c[(axis + 1) % 3] != 0 ? 1 : 0) + (a.c[(axis + 2) % 3] != 0 ? 2 : 0);
    }
    return -1;
}

void collect_rings(const CellShape& shape, std::array<Ring, 24>& rings, int& count) {
    count = 0;
    constexpr int kCorner[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    for (int face = 0; face < 6; ++face) {
        const int axis = face / 2;
        const int u = (axis + 1) % 3;
        const int v = (axis + 2) % 3;
        const bool split = (shape.split_faces >> face & 1) != 0;
        const int pieces = split ? 4 : 1;
        for (int piece = 0; piece < pieces; ++piece) {
            Ring& ring = rings[static_cast<std::size_t>(count++)];
            ring = {};
            ring.face = face;
            ring.whole = !split;
            const int edge = split ? 2 : 4;
            Point3 base{};
            base.c[axis] = face & 1 ? 4 : 0;
            base.c[u] = split ? 2 * (piece & 1) : 0;
            base.c[v] = split ? 2 * (piece >> 1) : 0;
            ring.centre = base;
            ring.centre.c[u] += edge / 2;
            ring.centre.c[v] += edge / 2;
            for (int n = 0; n < 4; ++n) {
                Point3 a = base;
                a.c[u] += edge * kCorner[n][0];
                a.c[v] += edge * kCorner[n][1];
                Point3 b = base;
                b.c[u] += edge * kCorner[(n + 1) % 4][0];
                b.c[v] += edge * kCorner[(n + 1) % 4][1];
                ring.points[static_cast<std::size_t>(ring.size++)] = a;
                if (!split && (shape.split_edges >> edge_between(a, b) & 1) != 0)
                    ring.points[static_cast<std::size_t>(ring.size++)] = midpoint(a, b);
            }
        }
    }
}

struct Arc {
    std::uint8_t first, second;
    std::uint8_t face;
    bool shared; // one of several on a whole face
};

// Pairs up the crossings of one ring. Crossings alternate between leaving and entering the inside; with four or more
// the centre decides whether the inside or the outside is connected across the face.
void add_arcs(const CellShape& shape, const Ring& ring, const std::function<bool(int)>& inside_at,
              std::array<Arc, 48>& arcs, int& arc_count) {
    std::array<std::uint8_t, 8> edge{};
    std::array<bool, 8> leaving{};
    int crossings = 0;
    for (int n = 0; n < ring.size; ++n) {
        const Point3& a = ring.points[static_cast<std::size_t>(n)];
        const Point3& b = ring.points[static_cast<std::size_t>((n + 1) % ring.size)];
        const bool ia = is_inside(shape, a);
        if (ia == is_inside(shape, b)) continue;
        edge[static_cast<std::size_t>(crossings)] = static_cast<std::uint8_t>(index_of(midpoint(a, b)));
        leaving[static_cast<std::size_t>(crossings++)] = ia;
    }
    if (crossings == 0) return;
    // Cut off each outside run when the centre is inside (its first crossing leaves), each inside run otherwise.
    const bool start_leaving = crossings == 2 ? leaving[0] : inside_at(index_of(ring.centre));
    const int start = leaving[0] == start_leaving ? 0 : 1;
    for (int n = 0; n < crossings; n += 2) {
        const auto first = static_cast<std::size_t>((start + n) % crossings);
        const auto second = static_cast<std::size_t>((start + n + 1) % crossings);
        arcs[static_cast<std::size_t>(arc_count++)] = {edge[first], edge[second], static_cast<std::uint8_t>(ring.face),
                                                       ring.whole && crossings > 2};
    }
}

std::array<CornerCase, 256> make_corner_cases() {
    std::array<CornerCase, 256> cases{};
    for (unsigned mask = 0; mask < 256; ++mask) {
        CornerCase& entry = cases[mask];
        CellShape shape;
        for (unsigned corner = 0; corner < 8; ++corner)
            if (mask >> corner & 1U)
                shape.inside |= 1U << (2 * (corner & 1) + 6 * (corner >> 1 & 1) + 18 * (corner >> 2));
        bool ambiguous = false;
        const CellLoops loops = trace_loops(shape, [&](int centre) {
            ambiguous = true;
            const int c[3] = {centre % 5, centre / 5 % 5, centre / 25};
            for (int axis = 0; axis < 3; ++axis)
                if (c[axis] != 2)
                    entry.ambiguous_faces |= static_cast<std::uint8_t>(1 << (2 * axis + (c[axis] == 4 ? 1 : 0)));
            return false;
        });
        if (ambiguous) continue;
        entry.loop_count = static_cast<std::uint8_t>(loops.loop_count);
        for (std::size_t e = 0; e < 12; ++e) {
            entry.loop_of_edge[e] = loops.loop_of[kEdges[e].midpoint];
            if (entry.loop_of_edge[e] != kNoLoop)
                entry.crossed_edges[entry.edge_count++] = static_cast<std::uint8_t>(e);
        }
    }
    return cases;
}

} // namespace

const std::array<EdgeGeometry, 12> kEdges = make_edges();

CellLoops trace_loops(const CellShape& shape, const std::function<bool(int)>& inside_at) {
    std::array<Ring, 24> rings;
    int ring_count = 0;
    collect_rings(shape, rings, ring_count);
    std::array<Arc, 48> arcs;
    int arc_count = 0;
    for (int n = 0; n < ring_count; ++n)
        add_arcs(shape, rings[static_cast<std::size_t>(n)], inside_at, arcs, arc_count);

    // Every crossed edge lies on two minimal faces, so it ends two arcs.
    std::array<std::array<std::int8_t, 2>, kQuarterPoints> ends;
    for (auto& pair : ends) pair = {-1, -1};
    for (int n = 0; n < arc_count; ++n) {
        for (const std::uint8_t edge :
             {arcs[static_cast<std::size_t>(n)].first, arcs[static_cast<std::size_t>(n)].second}) {
            auto& pair = ends[edge];
            assert(pair[1] == -1);
            pair[pair[0] == -1 ? 0 : 1] = static_cast<std::int8_t>(n);
        }
    }

    CellLoops loops;
    loops.loop_of.fill(kNoLoop);
    for (int n = 0; n < arc_count; ++n) {
        const std::uint8_t start = arcs[static_cast<std::size_t>(n)].first;
        if (loops.loop_of[start] != kNoLoop) continue;
        std::uint8_t edge = start;
        int arc = n;
        do {
            loops.loop_of[edge] = static_cast<std::uint8_t>(loops.loop_count);
            const Arc& along = arcs[static_cast<std::size_t>(arc)];
            edge = along.first == edge ? along.second : along.first;
            arc = ends[edge][0] == arc ? ends[edge][1] : ends[edge][0];
        } while (edge != start);
        ++loops.loop_count;
    }

    for (int n = 0; n < arc_count; ++n) {
        const Arc& arc = arcs[static_cast<std::size_t>(n)];
        if (!arc.shared) continue;
        for (int m = 0; m < arc_count; ++m) {
            const Arc& other = arcs[static_cast<std::size_t>(m)];
            if (m == n || other.face != arc.face || loops.loop_of[other.first] != loops.loop_of[arc.first]) continue;
            loops.shared_arcs.push_back({arc.face, arc.first, arc.second});
            break;
        }
    }
    return loops;
}

// After trace_loops and kEdges, which it needs.
const std::array<CornerCase, 256> kCornerCases = make_corner_cases();

} // namespace ramus::mesh::bricks
