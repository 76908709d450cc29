// What the surface does inside each brick: the sign pattern of its cells, the vertices of their loops, and where to
// find them from outside. Filled brick by brick (fill_subtrees), read by the pass that joins vertices into triangles.
#pragma once

#include "core/field/field.h"
#include "core/field/separation.h"
#include "core/mesh/polygonize/cells/cell_loops.h"
#include "core/mesh/polygonize/octree/neighbours.h"
#include "core/mesh/triangle_mesh.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace ramus::mesh::bricks {

inline constexpr int kCellsPerBrick = kBrickCells * kBrickCells * kBrickCells;
constexpr int cell_index(int x, int y, int z) { return x + 4 * y + 16 * z; }

// A vertex on an arc between two cells that would otherwise be joined twice.
struct ArcVertex {
    std::uint8_t face = 0;
    std::uint8_t edge = 0; // crossing at either end of the arc
    std::uint16_t vertex = 0;
};

// Cells that have more than one vertex, or may have.
struct CellRecord {
    std::array<std::uint8_t, kQuarterPoints> loop_of{}; // by minimal edge
    std::uint32_t walls = 0xFFFFFFFFU; // into SubtreeCells::upper_loops, where edges have walls; or kNoWalls
    std::uint32_t arcs_begin = 0;      // into SubtreeCells::arc_vertices
    std::uint32_t arcs_count = 0;
};

inline constexpr std::uint16_t kNoVertex = 0xFFFF;
inline constexpr std::uint32_t kNoWalls = 0xFFFFFFFFU;

// One bit per grid point of a brick, x + 5 y + 25 z.
__extension__ using GridBits = unsigned __int128;

constexpr int lowest_bit(GridBits bits) {
    const auto low = static_cast<std::uint64_t>(bits);
    return low != 0 ? std::countr_zero(low) : 64 + std::countr_zero(static_cast<std::uint64_t>(bits >> 64));
}

// From a grid point to the next one along each axis.
inline constexpr std::array<int, 3> kGridStep{1, 5, 25};
constexpr glm::ivec3 grid_point(int n) { return {n % 5, n / 5 % 5, n / 25}; }
// The same point of the lattice at quarter-cell spacing (lattice_axes()).
constexpr field::LatticePoint lattice_point(const glm::ivec3& p) {
    return {static_cast<std::uint8_t>(4 * p.x), static_cast<std::uint8_t>(4 * p.y), static_cast<std::uint8_t>(4 * p.z)};
}

// Grid points whose coordinates stay below the given limits.
constexpr GridBits grid_points_below(int x_end, int y_end, int z_end) {
    GridBits bits = 0;
    for (int z = 0; z < z_end; ++z)
        for (int y = 0; y < y_end; ++y)
            for (int x = 0; x < x_end; ++x) bits |= GridBits{1} << (x + 5 * y + 25 * z);
    return bits;
}
// Points on the lower side across each axis.
inline constexpr std::array<GridBits, 3> kLowerSides{grid_points_below(1, 5, 5), grid_points_below(5, 1, 5),
                                                     grid_points_below(5, 5, 1)};
// First points of the edges along each axis.
inline constexpr std::array<GridBits, 3> kEdgeStarts{grid_points_below(4, 5, 5), grid_points_below(5, 4, 5),
                                                     grid_points_below(5, 5, 4)};

struct BrickCells {
    std::array<std::uint16_t, kCellsPerBrick> first; // first vertex of each cell within the brick, or kNoVertex
    std::array<std::uint64_t, 2> inside;             // sign of each of the 125 grid points
    std::uint64_t recorded;                          // bit per cell: described by a record; others have one vertex
    std::uint32_t first_record;                      // in the subtree
    std::uint32_t first_vertex;                      // in the subtree, later in the mesh
    std::uint32_t walls;                             // into SubtreeCells::walls, or kNoWalls: neither of the two
    bool crossed;                                    // if not, all but this is left unset

    [[nodiscard]] GridBits grid_bits() const { return GridBits{inside[1]} << 64 | inside[0]; }
};

// Vertices side by side; the arrays go on for at least as long as projection writes beyond them.
struct SurfaceVertices : VertexArrays {
    std::size_t count = 0;

    void reserve(std::size_t more);
};

// Copies `count` vertices of `from`, those from `begin` on, to those from `at` on of arrays like a mesh's.
template <class Arrays>
void copy_vertices(const SurfaceVertices& from, std::size_t begin, Arrays& to, std::size_t at, std::size_t count) {
    std::copy_n(from.positions.data() + begin, count, to.positions.data() + at);
    std::copy_n(from.normals.data() + begin, count, to.normals.data() + at);
    std::copy_n(from.radii.data() + begin, count, to.radii.data() + at);
    std::copy_n(from.branches.data() + begin, count, to.branches.data() + at);
    if constexpr (requires { to.dominance; }) // those that are shown have them
        std::copy_n(from.dominance.data() + begin, count, to.dominance.data() + at);
}

struct SampleCounts {
    std::uint64_t evaluations = 0; // kernels, one per segment and point
    std::uint64_t samples = 0;     // points at which the field was taken
};

// Of a brick's edges, by their first points: those that walls go through, by axis; and those where the surface is a
// speck's (specks.h), which is left out: by axis, then by axis that of a wall's upper end.
struct BrickWalls {
    std::array<GridBits, 3> edges{};
    std::array<GridBits, 6> left_out{};
};

// What the bricks of one subtree make.
struct SubtreeCells {
    const SurfaceVertices* vertices = nullptr; // in which the subtree's are, until they are copied to the mesh
    std::size_t first_vertex = 0, vertex_count = 0;
    std::vector<CellRecord> records;
    std::vector<ArcVertex> arc_vertices;
    std::vector<BrickWalls> walls;
    std::vector<std::array<std::uint8_t, kQuarterPoints>> upper_loops; // as in CellRecord, of their upper ends
    std::vector<std::uint32_t> walled_bricks;                          // that have cells with walls
    SampleCounts counts;
    // It may be another one when bricks beside the subtree change; and when some do that are beside those.
    bool looked_beyond = false, looked_far = false;

    void add_arc(const FaceArc& arc, std::size_t vertex) {
        arc_vertices.push_back({arc.face, arc.first, static_cast<std::uint16_t>(vertex)});
        arc_vertices.push_back({arc.face, arc.second, static_cast<std::uint16_t>(vertex)});
    }
};

// What describes a cell that has a record.
inline const CellRecord& record_of(const BrickCells& brick, const SubtreeCells& subtree, int cell) {
    const int before = std::popcount(brick.recorded & ((std::uint64_t{1} << cell) - 1));
    return subtree.records[brick.first_record + static_cast<std::uint32_t>(before)];
}
// The loop of such a cell through a crossing, or kNoLoop.
inline std::uint8_t loop_of(const CellRecord& record, const SubtreeCells& subtree, int crossing) {
    if (crossing < kUpperEnd) return record.loop_of[static_cast<std::size_t>(crossing)];
    return record.walls == kNoWalls ? kNoLoop
                                    : subtree.upper_loops[record.walls][static_cast<std::size_t>(crossing - kUpperEnd)];
}

// Of a cell with walls: the loops all of whose crossings are at walls, a bit each.
inline std::uint64_t loops_along_walls(const CellRecord& record, const SubtreeCells& subtree) {
    const auto& upper = subtree.upper_loops[record.walls];
    std::uint64_t seen = 0, elsewhere = 0;
    for (std::size_t m = 0; m < kQuarterPoints; ++m) {
        const std::uint8_t lower = record.loop_of[m];
        if (lower == kNoLoop) continue;
        seen |= std::uint64_t{1} << lower;
        if (upper[m] == kNoLoop)
            elsewhere |= std::uint64_t{1} << lower;
        else
            seen |= std::uint64_t{1} << upper[m];
    }
    return seen & ~elsewhere;
}

struct SurfaceCells {
    ChunkedArray<Neighbourhood> neighbours;                        // by brick
    ChunkedArray<BrickCells> cells;                                // by brick
    std::vector<SubtreeCells> subtrees;                            // by subtree
    std::vector<std::unique_ptr<SurfaceVertices>> vertices, spare; // blocks in use, and to be used

    void reuse_vertices(); // all are copied to the mesh

    [[nodiscard]] bool is_recorded(std::uint32_t brick, int cell) const {
        return (cells[brick].recorded >> cell & 1U) != 0;
    }
    [[nodiscard]] const CellRecord& record(const Brick& brick, std::uint32_t index, int cell) const;
    // Vertex (within the mesh once first_vertex is) of the loop through a crossing; kAbsent where a wall has none.
    static constexpr std::uint32_t kAbsent = 0xFFFFFFFFU;
    [[nodiscard]] std::uint32_t vertex(const Brick& brick, std::uint32_t index, int cell, int crossing) const;
    // Of a brick that has them.
    [[nodiscard]] const BrickWalls& walls(const Brick& brick, std::uint32_t index) const {
        return subtrees[brick.subtree].walls[cells[index].walls];
    }
};

// Samples the bricks of some subtrees, finds the loops of their cells and places the vertices on the surface. Needs the
// subtrees' neighbourhoods. Incomplete when cancelled.
void fill_subtrees(const field::Field& field, const Octree& octree, std::span<const std::uint32_t> subtrees,
                   SurfaceCells& surface, const JobRange& job);

// Whether some polygon of the subtree may have vertices in subtrees that changed: where the surface crosses the
// boundary between them.
[[nodiscard]] bool reaches_beyond(const Octree& octree, const SurfaceCells& surface, std::uint32_t subtree,
                                  const OctreeChanges& changes);

// Moves guesses in a brick, which `field` is in, onto the surface and appends them to `vertices`. Returns the number of
// kernels evaluated. `owned`: whose they are, where vessels are kept apart.
std::uint64_t append_projected(field::BrickField& field, field::Projection& guesses, SurfaceVertices& vertices,
                               std::span<const field::OwnedGuess> owned = {});

[[nodiscard]] field::GridAxes grid_axes(const Lattice& lattice, const Brick& brick);
// Coordinates of the brick's points at quarter-cell spacing.
[[nodiscard]] field::LatticeAxes lattice_axes(const Lattice& lattice, const Brick& brick);

} // namespace ramus::mesh::bricks
