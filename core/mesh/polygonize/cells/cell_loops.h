// Cell loops: how the surface crosses one cell's boundary. A cell is a cube whose faces may be split into four and
// whose edges into two where finer cells touch it ("hanging" corners). The crossings of its minimal edges are joined by
// arcs across its minimal faces; the arcs close into loops, and each loop becomes one vertex of the dual mesh. Both
// cells at a minimal face see the same arcs, so the polygons around crossed edges fit without cracks and every vertex
// has one ring of polygons.
//
// Points of a cell are written on its 5 x 5 x 5 grid of quarter steps, index x + 5 y + 25 z: corners at 0 and 4,
// hanging corners at 2, midpoints of half edges at 1 and 3. A minimal edge is named by its midpoint, which also tells a
// whole edge (2 on one axis, 0 or 4 on the others) from its halves.
//
// Two points inside may belong to vessels that are kept apart. The surface crosses an edge between them twice: once
// for the vessel of the lower end, once for that of the upper one. So a crossing is named by its edge, or by its edge
// and kUpperEnd. Runs of points of one vessel around a face are cut off from each other like runs of points inside, but
// for those that are connected by way of the face's centre, where that is inside and theirs.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <utility>
#include <vector>

namespace ramus::mesh::bricks {

inline constexpr int kQuarterPoints = 125;
inline constexpr int kUpperEnd = kQuarterPoints; // added to the name of an edge
inline constexpr int kCrossings = 2 * kQuarterPoints;
inline constexpr std::uint8_t kNoLoop = 0xFF;
inline constexpr std::size_t kMostLoops = 48; // a loop has two crossings or more, two at most of 48 minimal edges

constexpr int quarter_index(int x, int y, int z) { return x + 5 * y + 25 * z; }

// Edges 0..11: 4 axis + u + 2 v, where u and v (0 or 1) place it on the other two axes in cyclic order
// (x: y z, y: z x, z: x y).
constexpr int edge_midpoint(int edge) {
    int c[3] = {0, 0, 0};
    c[edge / 4] = 2;
    c[(edge / 4 + 1) % 3] = 4 * (edge & 1);
    c[(edge / 4 + 2) % 3] = 4 * (edge >> 1 & 1);
    return quarter_index(c[0], c[1], c[2]);
}

// The ends of a crossing's edge on the quarter grid: one step along its axis for a half edge (odd coordinate), two for
// a whole one.
[[nodiscard]] const std::pair<glm::ivec3, glm::ivec3>& ends_of_edge(int crossing);

// By the signs of the corners (bit 1 = x, 2 = y, 4 = z of the bit's number): crossed in exactly one loop, whatever the
// signs at the centres of the faces, if no corners hang.
extern const std::array<bool, 256> kPlainCells;

// A cell with its neighbourhood.
struct CellShape {
    std::uint8_t split_faces = 0;  // bit 2 axis + side: four finer faces
    std::uint16_t split_edges = 0; // bit = edge: two finer edges
    std::uint32_t inside = 0;      // bit x + 3 y + 9 z of the 3 x 3 x 3 corners and hanging corners
};

// For each of a cell's 27 corners and hanging corners the others that belong to a vessel apart from its own.
using ApartPoints = std::array<std::uint32_t, 27>;

struct FaceArc {
    std::uint8_t face = 0;              // 2 axis + side
    std::uint8_t first = 0, second = 0; // crossings that the arc joins
};

struct CellLoops {
    int loop_count = 0;
    std::array<std::uint8_t, kCrossings> loop_of{}; // by crossing; kNoLoop too where a wall ends between points of both
    // Arcs of whole faces that need a vertex of their own: where some loop crosses the face more than once, since, if
    // the cell beyond does the same, two arcs would join the same two vertices.
    std::vector<FaceArc> own_arcs;
};

// Centres of minimal faces with four or more crossings: their signs decide how the crossings pair up, and, where some
// points of the face are apart, whose they are.
struct FaceCentres {
    std::array<std::uint8_t, 24> centre{}; // quarter indices
    int count = 0;
    std::uint32_t inside = 0; // bit n: the n-th centre is inside
    std::uint32_t walled = 0; // bit n: around it some points are apart
    // Of a centre inside, where some are apart: the cell's points that are apart from it, bits of CellShape::inside.
    std::array<std::uint32_t, 24> apart{};
};

// Traces the loops. `apart`: where the cell has points of vessels that are kept apart; or null. Goes by the signs in
// `centres.inside`, and lists there the centres that it went by, in the same order whatever their signs.
[[nodiscard]] CellLoops trace_loops(const CellShape& shape, FaceCentres& centres, const ApartPoints* apart = nullptr);

} // namespace ramus::mesh::bricks
