#include "core/mesh/polygonize/cells/cell_loops.h"

#include <algorithm>
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

int edge_between(const Point3& a, const Point3& b) {
    for (int axis = 0; axis < 3; ++axis) {
        if (a.c[axis] == b.c[axis]) continue;
        return 4 * axis + (a.c[(axis + 1) % 3] != 0 ? 1 : 0) + (a.c[(axis + 2) % 3] != 0 ? 2 : 0);
    }
    return -1;
}

// A point on the ring around a face, as a bit of CellShape::inside, and the minimal edge from it to the next.
struct RingPoint {
    std::uint8_t bit, midpoint;
};
// A side of a whole face: one edge, or two where it is split.
struct RingSide {
    std::uint8_t edge;
    RingPoint whole;
    std::array<RingPoint, 2> halves;
};
// A face of a cell, counter-clockwise seen from outside for its upper side, and its four quarters.
struct FaceRings {
    std::array<RingSide, 4> sides;
    std::uint8_t centre;
    std::array<std::array<RingPoint, 4>, 4> quarters;
    std::array<std::uint8_t, 4> quarter_centres;
};

std::array<FaceRings, 6> make_faces() {
    const auto bit_of = [](const Point3& p) {
        return static_cast<std::uint8_t>(p.c[0] / 2 + 3 * (p.c[1] / 2) + 9 * (p.c[2] / 2));
    };
    const auto point = [&](const Point3& from, const Point3& to) {
        return RingPoint{bit_of(from), static_cast<std::uint8_t>(index_of(midpoint(from, to)))};
    };
    constexpr int kCorner[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    std::array<FaceRings, 6> faces{};
    for (int face = 0; face < 6; ++face) {
        const int u = (face / 2 + 1) % 3;
        const int v = (face / 2 + 2) % 3;
        const auto at = [&](int along_u, int along_v) {
            Point3 p{};
            p.c[face / 2] = (face & 1) != 0 ? 4 : 0;
            p.c[u] = along_u;
            p.c[v] = along_v;
            return p;
        };
        FaceRings& rings = faces[static_cast<std::size_t>(face)];
        rings.centre = static_cast<std::uint8_t>(index_of(at(2, 2)));
        for (int n = 0; n < 4; ++n) {
            const auto i = static_cast<std::size_t>(n);
            const int* from = kCorner[n];
            const int* to = kCorner[(n + 1) % 4];
            const Point3 a = at(4 * from[0], 4 * from[1]);
            const Point3 b = at(4 * to[0], 4 * to[1]);
            const Point3 m = midpoint(a, b);
            rings.sides[i] = {static_cast<std::uint8_t>(edge_between(a, b)), point(a, b), {point(a, m), point(m, b)}};
            for (int quarter = 0; quarter < 4; ++quarter) {
                const int du = 2 * (quarter & 1);
                const int dv = 2 * (quarter >> 1);
                const auto q = static_cast<std::size_t>(quarter);
                rings.quarters[q][i] =
                    point(at(du + 2 * from[0], dv + 2 * from[1]), at(du + 2 * to[0], dv + 2 * to[1]));
                rings.quarter_centres[q] = static_cast<std::uint8_t>(index_of(at(du + 1, dv + 1)));
            }
        }
    }
    return faces;
}
const std::array<FaceRings, 6> kFaces = make_faces();

struct Arc {
    std::uint8_t first, second;
    std::uint8_t face;
    bool shared; // one of several on a whole face
};

struct Arcs {
    std::array<Arc, 48> arc;
    int count = 0;
};

// A ring around a minimal face.
struct Ring {
    std::array<RingPoint, 8> points;
    std::size_t size = 0;
    std::uint8_t face, centre;
    bool whole; // not a quarter of a split face
};

// Pairs up the crossings of one ring. Crossings alternate between leaving and entering the inside; with four or more
// the centre decides whether the inside or the outside is connected across the face.
void add_arcs(std::uint32_t inside, const Ring& ring, FaceCentres& centres, Arcs& arcs) {
    std::array<std::uint8_t, 8> edge;
    std::size_t crossings = 0;
    bool first_leaves = false;
    bool sign = (inside >> ring.points[0].bit & 1U) != 0;
    for (std::size_t n = 0; n < ring.size; ++n) {
        const bool next = (inside >> ring.points[n + 1 < ring.size ? n + 1 : 0].bit & 1U) != 0;
        if (sign != next) {
            if (crossings == 0) first_leaves = sign;
            edge[crossings++] = ring.points[n].midpoint;
        }
        sign = next;
    }
    if (crossings == 0) return;
    // Cut off each outside run when the centre is inside (its first crossing leaves), each inside run otherwise.
    bool start_leaving = first_leaves;
    if (crossings > 2) {
        start_leaving = (centres.inside >> centres.count & 1U) != 0;
        centres.centre[static_cast<std::size_t>(centres.count++)] = ring.centre;
    }
    const std::size_t start = first_leaves == start_leaving ? 0 : 1;
    for (std::size_t n = 0; n < crossings; n += 2)
        arcs.arc[static_cast<std::size_t>(arcs.count++)] = {
            edge[(start + n) % crossings], edge[(start + n + 1) % crossings], ring.face, ring.whole && crossings > 2};
}

Arcs collect_arcs(const CellShape& shape, FaceCentres& centres) {
    Arcs arcs;
    centres.count = 0;
    for (std::uint8_t face = 0; face < 6; ++face) {
        const FaceRings& rings = kFaces[face];
        Ring ring;
        ring.face = face;
        ring.whole = (shape.split_faces >> face & 1) == 0;
        if (!ring.whole) {
            ring.size = 4;
            for (std::size_t quarter = 0; quarter < 4; ++quarter) {
                std::ranges::copy(rings.quarters[quarter], ring.points.begin());
                ring.centre = rings.quarter_centres[quarter];
                add_arcs(shape.inside, ring, centres, arcs);
            }
            continue;
        }
        for (const RingSide& side : rings.sides) {
            if ((shape.split_edges >> side.edge & 1) != 0) {
                ring.points[ring.size++] = side.halves[0];
                ring.points[ring.size++] = side.halves[1];
            } else {
                ring.points[ring.size++] = side.whole;
            }
        }
        ring.centre = rings.centre;
        add_arcs(shape.inside, ring, centres, arcs);
    }
    return arcs;
}

std::array<bool, 256> find_plain_cells() {
    std::array<bool, 256> plain{};
    for (unsigned mask = 0; mask < 256; ++mask) {
        CellShape shape;
        for (unsigned corner = 0; corner < 8; ++corner)
            if (mask >> corner & 1U)
                shape.inside |= 1U << (2 * (corner & 1) + 6 * (corner >> 1 & 1) + 18 * (corner >> 2));
        FaceCentres centres;
        const CellLoops loops = trace_loops(shape, centres);
        plain[mask] = centres.count == 0 && loops.loop_count == 1;
    }
    return plain;
}

} // namespace

CellLoops trace_loops(const CellShape& shape, FaceCentres& centres) {
    const Arcs found = collect_arcs(shape, centres);
    const auto& arcs = found.arc;
    const int arc_count = found.count;

    // Every crossed edge lies on two minimal faces, so it ends two arcs.
    std::array<std::array<std::int8_t, 2>, kQuarterPoints> ends;
    ends.fill({-1, -1});
    for (int n = 0; n < arc_count; ++n) {
        const Arc& arc = arcs[static_cast<std::size_t>(n)];
        for (const std::uint8_t edge : {arc.first, arc.second}) {
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

// After kFaces, which it needs.
const std::array<bool, 256> kPlainCells = find_plain_cells();

} // namespace ramus::mesh::bricks
