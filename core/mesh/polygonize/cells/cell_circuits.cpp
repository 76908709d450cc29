#include "core/mesh/polygonize/cells/cell_circuits.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <utility>

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
// A side of a whole face: one edge, or two halves.
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
    std::array<Arc, 96> arc;
    int count = 0;

    void add(std::uint8_t first, std::uint8_t second, Arc kind) {
        kind.first = first, kind.second = second;
        arc[static_cast<std::size_t>(count++)] = kind;
    }
};

// A ring around a minimal face.
struct Ring {
    std::array<RingPoint, 8> points;
    std::size_t size = 0;
    std::uint8_t face, centre;
    bool whole; // not a quarter of a split face
};

// The crossings around a ring in order: they alternate between leaving and entering the inside.
struct RingCrossings {
    std::array<std::uint8_t, 16> crossing;
    std::array<std::uint32_t, 16> before{}; // the points inside between a crossing and the one before it
    std::size_t count = 0;
    bool first_leaves = false;
    bool any_apart = false; // some of the points that are inside are apart

    void add(std::uint8_t midpoint, bool leaves) {
        if (count == 0) first_leaves = leaves;
        crossing[count++] = midpoint;
    }
};
RingCrossings crossings_of(std::uint32_t inside, const Ring& ring, const ApartPoints* apart) {
    RingCrossings found;
    bool sign = (inside >> ring.points[0].bit & 1U) != 0;
    std::uint32_t seen = 0;
    for (std::size_t n = 0; n < ring.size; ++n) {
        const RingPoint& from = ring.points[n];
        const RingPoint& to = ring.points[n + 1 < ring.size ? n + 1 : 0];
        const bool next = (inside >> to.bit & 1U) != 0;
        seen |= inside & 1U << from.bit;
        if (sign != next) {
            found.before[found.count] = std::exchange(seen, 0U);
            found.add(from.midpoint, sign);
        } else if (apart != nullptr && sign && ((*apart)[from.bit] >> to.bit & 1U) != 0) {
            const auto upper = static_cast<std::uint8_t>(from.midpoint + kUpperEnd);
            found.before[found.count] = std::exchange(seen, 0U);
            found.add(from.bit < to.bit ? from.midpoint : upper, true);
            found.add(from.bit < to.bit ? upper : from.midpoint, false);
        }
        sign = next;
    }
    found.before[0] |= seen;
    if (apart == nullptr || found.count == 0) return found;
    std::uint32_t around = 0;
    for (std::size_t n = 0; n < ring.size; ++n) around |= 1U << ring.points[n].bit;
    for (std::size_t n = 0; n < ring.size; ++n)
        found.any_apart = found.any_apart || ((*apart)[ring.points[n].bit] & around) != 0;
    return found;
}

// A run of points of one vessel around a ring.
struct Run {
    std::uint8_t enters, leaves; // crossings
    std::uint32_t points;
};
struct Runs {
    std::array<Run, 8> run;
    std::size_t count = 0;
};
Runs runs_of(const RingCrossings& found) {
    Runs runs;
    for (std::size_t n = found.first_leaves ? 1 : 0; runs.count < found.count / 2; n += 2) {
        const std::size_t leaves = (n + 1) % found.count;
        runs.run[runs.count++] = {found.crossing[n], found.crossing[leaves], found.before[leaves]};
    }
    return runs;
}

// Whether two runs of a ring may be of one vessel.
bool may_be_one(const Runs& runs, const ApartPoints& apart) {
    for (std::size_t a = 1; a < runs.count; ++a)
        for (std::size_t b = 0; b < a; ++b) {
            std::uint32_t others = 0;
            for (std::uint32_t left = runs.run[a].points; left != 0; left &= left - 1)
                others |= apart[static_cast<std::size_t>(std::countr_zero(left))];
            if ((others & runs.run[b].points) == 0) return true;
        }
    return false;
}

// Adds the centre of a ring to the list. Returns whether it is inside.
bool ask_centre(FaceCentres& centres, const Ring& ring, bool walled) {
    const auto n = static_cast<std::size_t>(centres.count++);
    centres.centre[n] = ring.centre;
    if (walled) centres.walled |= 1U << n;
    return (centres.inside >> n & 1U) != 0;
}

// Pairs the crossings of a ring with points that are apart: separates all runs, except those of the centre's owner.
void add_arcs_of_runs(const Runs& runs, const Ring& ring, const ApartPoints& apart, FaceCentres& centres,
                      const Arc& kind, Arcs& arcs) {
    std::array<std::size_t, 8> joined{};
    std::size_t count = 0;
    if (runs.count > 1 && may_be_one(runs, apart) && ask_centre(centres, ring, true))
        for (std::size_t n = 0; n < runs.count; ++n)
            if ((runs.run[n].points & centres.apart[static_cast<std::size_t>(centres.count - 1)]) == 0)
                joined[count++] = n;
    std::size_t next = 0; // in joined
    for (std::size_t n = 0; n < runs.count; ++n) {
        const Run& run = runs.run[n];
        if (count > 1 && next < count && joined[next] == n)
            arcs.add(run.leaves, runs.run[joined[++next % count]].enters, kind);
        else
            arcs.add(run.enters, run.leaves, kind);
    }
}

// Pairs the crossings of one ring. With four or more, the centre decides whether the inside or the outside is connected
// across the face. Points that are apart are never connected.
void add_arcs(const CellShape& shape, const Ring& ring, const ApartPoints* apart, FaceCentres& centres, Arcs& arcs) {
    const RingCrossings found = crossings_of(shape.inside, ring, apart);
    if (found.count == 0) return;
    const Arc kind{0, 0, ring.face, ring.whole && found.count > 2};
    if (found.any_apart) return add_arcs_of_runs(runs_of(found), ring, *apart, centres, kind, arcs);
    // Separates each run outside if the centre is inside (the first crossing of such a run leaves the inside), and each
    // run inside otherwise.
    const bool start_leaving = found.count > 2 ? ask_centre(centres, ring, false) : found.first_leaves;
    const std::size_t start = found.first_leaves == start_leaving ? 0 : 1;
    for (std::size_t n = 0; n < found.count; n += 2)
        arcs.add(found.crossing[(start + n) % found.count], found.crossing[(start + n + 1) % found.count], kind);
}

Arcs collect_arcs(const CellShape& shape, FaceCentres& centres, const ApartPoints* apart) {
    Arcs arcs;
    centres.count = 0;
    centres.walled = 0;
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
                add_arcs(shape, ring, apart, centres, arcs);
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
        add_arcs(shape, ring, apart, centres, arcs);
    }
    return arcs;
}

// A wall through only one edge, whose ends are apart although all points around belong to both, has two coincident
// sides: circuits that consist of its two crossings, and are no surface.
void drop_lenses(CellCircuits& circuits) {
    std::array<int, kMostCircuits> crossings{}, walls{};
    for (int edge = 0; edge < kQuarterPoints; ++edge) {
        const std::uint8_t lower = circuits.circuit_of[static_cast<std::size_t>(edge)];
        const std::uint8_t upper = circuits.circuit_of[static_cast<std::size_t>(edge + kUpperEnd)];
        if (lower != kNoCircuit) ++crossings[lower];
        if (upper != kNoCircuit) ++crossings[upper];
        if (lower != kNoCircuit && lower == upper) ++walls[lower];
    }
    std::array<std::uint8_t, kMostCircuits> number{};
    int left = 0;
    for (std::size_t circuit = 0; circuit < static_cast<std::size_t>(circuits.circuit_count); ++circuit) {
        const bool lens = crossings[circuit] == 2 && walls[circuit] == 1;
        number[circuit] = lens ? kNoCircuit : static_cast<std::uint8_t>(left++);
    }
    if (left == circuits.circuit_count) return;
    for (std::uint8_t& circuit : circuits.circuit_of)
        if (circuit != kNoCircuit) circuit = number[circuit];
    circuits.circuit_count = left;
}

std::array<bool, 256> find_plain_cells() {
    std::array<bool, 256> plain{};
    for (unsigned mask = 0; mask < 256; ++mask) {
        CellShape shape;
        for (unsigned corner = 0; corner < 8; ++corner)
            if (mask >> corner & 1U)
                shape.inside |= 1U << (2 * (corner & 1) + 6 * (corner >> 1 & 1) + 18 * (corner >> 2));
        FaceCentres centres;
        const CellCircuits circuits = trace_circuits(shape, centres);
        plain[mask] = centres.count == 0 && circuits.circuit_count == 1;
    }
    return plain;
}

std::pair<glm::ivec3, glm::ivec3> find_ends(int edge) {
    const glm::ivec3 middle(edge % 5, edge / 5 % 5, edge / 25);
    int axis = -1;
    int step = 1;
    for (int i = 0; i < 3; ++i)
        if ((middle[i] & 1) != 0) axis = i;
    if (axis < 0) {
        step = 2;
        for (int i = 0; i < 3; ++i)
            if (middle[i] == 2) axis = i;
    }
    if (axis < 0) return {middle, middle}; // a corner
    glm::ivec3 low = middle;
    glm::ivec3 high = middle;
    low[axis] -= step;
    high[axis] += step;
    return {low, high};
}

} // namespace

const std::pair<glm::ivec3, glm::ivec3>& ends_of_edge(int crossing) {
    static const auto ends = [] {
        std::array<std::pair<glm::ivec3, glm::ivec3>, kQuarterPoints> found{};
        for (int edge = 0; edge < kQuarterPoints; ++edge) found[static_cast<std::size_t>(edge)] = find_ends(edge);
        return found;
    }();
    return ends[static_cast<std::size_t>(crossing % kQuarterPoints)];
}

CellCircuits trace_circuits(const CellShape& shape, FaceCentres& centres, const ApartPoints* apart) {
    const Arcs found = collect_arcs(shape, centres, apart);
    const auto& arcs = found.arc;
    const int arc_count = found.count;

    // Every crossing lies on two minimal faces, so it is the end of two arcs.
    std::array<std::array<std::int8_t, 2>, kCrossings> ends;
    ends.fill({-1, -1});
    for (int n = 0; n < arc_count; ++n) {
        const Arc& arc = arcs[static_cast<std::size_t>(n)];
        for (const std::uint8_t edge : {arc.first, arc.second}) {
            auto& pair = ends[edge];
            assert(pair[1] == -1);
            pair[pair[0] == -1 ? 0 : 1] = static_cast<std::int8_t>(n);
        }
    }

    CellCircuits circuits;
    circuits.circuit_of.fill(kNoCircuit);
    for (int n = 0; n < arc_count; ++n) {
        const std::uint8_t start = arcs[static_cast<std::size_t>(n)].first;
        if (circuits.circuit_of[start] != kNoCircuit) continue;
        std::uint8_t edge = start;
        int arc = n;
        do {
            circuits.circuit_of[edge] = static_cast<std::uint8_t>(circuits.circuit_count);
            const Arc& along = arcs[static_cast<std::size_t>(arc)];
            edge = along.first == edge ? along.second : along.first;
            arc = ends[edge][0] == arc ? ends[edge][1] : ends[edge][0];
        } while (edge != start);
        ++circuits.circuit_count;
    }

    if (apart != nullptr) drop_lenses(circuits);
    for (int n = 0; n < arc_count; ++n) {
        const Arc& arc = arcs[static_cast<std::size_t>(n)];
        if (!arc.shared || circuits.circuit_of[arc.first] == kNoCircuit) continue;
        bool own_vertex = false;
        for (int m = 0; m < arc_count && !own_vertex; ++m) {
            const Arc& other = arcs[static_cast<std::size_t>(m)];
            own_vertex =
                m != n && other.face == arc.face && circuits.circuit_of[other.first] == circuits.circuit_of[arc.first];
        }
        if (own_vertex) circuits.own_arcs.push_back({arc.face, arc.first, arc.second});
    }
    return circuits;
}

// Must be initialised after kFaces.
const std::array<bool, 256> kPlainCells = find_plain_cells();

} // namespace ramus::mesh::bricks
