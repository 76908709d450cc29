// Cell circuits: the circuits in which the surface crosses the boundary of one cell. A cell is a cube whose faces may
// be divided into four, and whose edges into two, where finer cells touch it (hanging corners). The crossings of its
// minimal edges are connected by arcs across its minimal faces. The arcs close into circuits, and each circuit becomes
// one vertex of the dual mesh. Both cells at a minimal face have the same arcs. So the polygons around crossed edges
// fit without cracks, and every vertex has one ring of polygons.
//
// Points of a cell are given on its 5 x 5 x 5 grid of quarter steps, index x + 5 y + 25 z: corners at 0 and 4, hanging
// corners at 2, midpoints of half edges at 1 and 3. A minimal edge is identified by its midpoint. For a whole edge one
// coordinate of the midpoint is 2 and the others are 0 or 4; a half edge has an odd coordinate.
//
// Two points inside may belong to vessels that are kept apart. The surface crosses an edge between them twice: once for
// the vessel of the lower end, once for the vessel of the upper end. So a crossing is identified by its edge, or by its
// edge plus kUpperEnd. Around a face, runs of points of different vessels are separated like runs of points inside and
// outside. Only runs that belong to the owner of the face's centre are connected, if the centre is inside.
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
inline constexpr std::uint8_t kNoCircuit = 0xFF;
// 48 minimal edges have up to two crossings each; a circuit has at least two.
inline constexpr std::size_t kMostCircuits = 48;

constexpr int quarter_index(int x, int y, int z) { return x + 5 * y + 25 * z; }

// Edges have the numbers 0 to 11: 4 axis + u + 2 v, where u and v (0 or 1) are the positions on the other two axes in
// cyclic order (x: y z, y: z x, z: x y).
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

// By the signs of the eight corners: whether a cell without hanging corners is crossed in exactly one circuit, whatever
// the signs at the centres of its faces. Bit n is the corner with x = n & 1, y = n >> 1 & 1, z = n >> 2.
extern const std::array<bool, 256> kPlainCells;

// A cell with its neighbourhood.
struct CellShape {
    std::uint8_t split_faces = 0;  // bit 2 axis + side: four finer faces
    std::uint16_t split_edges = 0; // bit = edge: two finer edges
    std::uint32_t inside = 0;      // bit x + 3 y + 9 z of the 3 x 3 x 3 corners and hanging corners
};

// For each of a cell's 27 corners and hanging corners, the points of vessels that are apart from its vessel.
using ApartPoints = std::array<std::uint32_t, 27>;

struct FaceArc {
    std::uint8_t face = 0;              // 2 axis + side
    std::uint8_t first = 0, second = 0; // crossings at its ends
};

struct CellCircuits {
    int circuit_count = 0;
    std::array<std::uint8_t, kCrossings> circuit_of{}; // by crossing; kNoCircuit also where a wall has no surface
    // Arcs of whole faces that need a vertex of their own, since a circuit crosses the face more than once: if the cell
    // beyond does the same, two arcs would connect the same two vertices.
    std::vector<FaceArc> own_arcs;
};

// The centres of minimal faces with four or more crossings. Their signs decide how the crossings are paired, and so do
// their owners if some points of the face are apart.
struct FaceCentres {
    std::array<std::uint8_t, 24> centre{}; // quarter indices
    int count = 0;
    std::uint32_t inside = 0; // bit n: the n-th centre is inside
    std::uint32_t walled = 0; // bit n: some points around the n-th centre are apart
    // By centre that is inside and walled: the cell's points that are apart from it, as bits of CellShape::inside.
    std::array<std::uint32_t, 24> apart{};
};

// Traces the circuits of a cell. `apart`: the points of vessels that are kept apart, or null. Uses the signs in
// `centres.inside`, and lists the centres that matter in `centres`, in an order that does not depend on their signs.
[[nodiscard]] CellCircuits trace_circuits(const CellShape& shape, FaceCentres& centres,
                                          const ApartPoints* apart = nullptr);

} // namespace ramus::mesh::bricks
