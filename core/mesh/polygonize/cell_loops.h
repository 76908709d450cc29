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
#include <cstdint>
#include <functional>
#include <vector>

namespace ramus::mesh::bricks {

inline constexpr int kQuarterPoints = 125;
inline constexpr std::uint8_t kNoLoop = 0xFF;

constexpr int quarter_index(int x, int y, int z) { return x + 5 * y + 25 * z; }

// Edges 0..11: 4 axis + u + 2 v, where u and v (0 or 1) place it on the other two axes in cyclic order
// (x: y z, y: z x, z: x y).
struct EdgeGeometry {
    std::uint8_t from = 0, to = 0; // corners, bit 0 = x, bit 1 = y, bit 2 = z
    std::uint8_t midpoint = 0;     // quarter index
};
extern const std::array<EdgeGeometry, 12> kEdges;

// Corner signs alone decide a cell without hanging corners and ambiguous faces.
struct CornerCase {
    std::uint8_t loop_count = 0;
    std::uint8_t ambiguous_faces = 0; // bit 2 axis + side; loops are not filled in where any is set
    std::uint8_t edge_count = 0;
    std::array<std::uint8_t, 12> crossed_edges{}; // the first edge_count entries
    std::array<std::uint8_t, 12> loop_of_edge{};  // kNoLoop where the edge is not crossed
};
extern const std::array<CornerCase, 256> kCornerCases;

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

// Traces the loops. `inside_at(quarter index)` tells the sign at the centre of a face with four or more crossings,
// which decides how they pair up.
[[nodiscard]] CellLoops trace_loops(const CellShape& shape, const std::function<bool(int)>& inside_at);

} // namespace ramus::mesh::bricks
