// Cell loops: how the surface crosses one cell's boundary. A cell is a cube whose faces may be split into four and
// whose edges into two where finer cells touch it ("hanging" corners). The crossings of its minimal edges are joined by
// arcs across its minimal faces; the arcs close into loops, and each loop becomes one vertex of the dual mesh. Both
// cells at a minimal face see the same arcs, so the polygons around crossed edges fit without cracks and every vertex
// has one ring of polygons.
//
// Points of a cell are written on its 5 x 5 x 5 grid of quarter steps, index x + 5 y + 25 z: corners at 0 and 4,
// hanging corners at 2, midpoints of half edges at 1 and 3. A minimal edge is named by its midpoint, which also tells a
// whole edge (2 on one axis, 0 or 4 on the others) from its halves.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace ramus::mesh::bricks {

inline constexpr int kQuarterPoints = 125;
inline constexpr std::uint8_t kNoLoop = 0xFF;
inline constexpr std::size_t kMostLoops = 16; // a loop has three crossings or more, of at most 48 minimal edges

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

// By the signs of the corners (bit 1 = x, 2 = y, 4 = z of the bit's number): crossed in exactly one loop, whatever the
// signs at the centres of the faces, if no corners hang.
extern const std::array<bool, 256> kPlainCells;

// A cell with its neighbourhood.
struct CellShape {
    std::uint8_t split_faces = 0;  // bit 2 axis + side: four finer faces
    std::uint16_t split_edges = 0; // bit = edge: two finer edges
    std::uint32_t inside = 0;      // bit x + 3 y + 9 z of the 3 x 3 x 3 corners and hanging corners
};

struct FaceArc {
    std::uint8_t face = 0;              // 2 axis + side
    std::uint8_t first = 0, second = 0; // minimal edges that the arc joins
};

struct CellLoops {
    int loop_count = 0;
    std::array<std::uint8_t, kQuarterPoints> loop_of{}; // by minimal edge
    // Arcs of whole faces that some loop crosses more than once. If the cell beyond does the same, two arcs would join
    // the same two vertices: such arcs need a vertex of their own.
    std::vector<FaceArc> shared_arcs;
};

// Centres of minimal faces with four or more crossings: their signs decide how the crossings pair up.
struct FaceCentres {
    std::array<std::uint8_t, 24> centre{}; // quarter indices
    int count = 0;
    std::uint32_t inside = 0; // bit n: the n-th centre is inside
};

// Traces the loops. Goes by the signs in `centres.inside`, and lists there the centres that it went by, in the same
// order whatever their signs.
[[nodiscard]] CellLoops trace_loops(const CellShape& shape, FaceCentres& centres);

} // namespace ramus::mesh::bricks
