// BrickCells: the surface inside each brick: the signs of its grid points, and the vertices of the circuits of its
// cells. fill_subtrees() fills them brick by brick; the next step (join/) connects the vertices by triangles.
#pragma once

#include "core/field/field.h"
#include "core/field/separation.h"
#include "core/mesh/polygonize/cells/cell_circuits.h"
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

// A vertex on an arc between two cells whose vertices would otherwise be connected twice.
struct ArcVertex {
    std::uint8_t face = 0;
    std::uint8_t edge = 0; // crossing at either end of the arc
    std::uint16_t vertex = 0;
};

// The description of a cell that has, or may have, more than one vertex.
struct CellRecord {
    std::array<std::uint8_t, kQuarterPoints> circuit_of{}; // by minimal edge
    std::uint32_t walls = 0xFFFFFFFFU; // index into SubtreeCells::upper_circuits if edges have walls, else kNoWalls
    std::uint32_t arcs_begin = 0;      // index into SubtreeCells::arc_vertices
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

// The index step from a grid point to the next one along each axis.
inline constexpr std::array<int, 3> kGridStep{1, 5, 25};
constexpr glm::ivec3 grid_point(int n) { return {n % 5, n / 5 % 5, n / 25}; }
// A grid point as a point of the lattice at quarter-cell spacing (lattice_axes()).
constexpr field::LatticePoint lattice_point(const glm::ivec3& p) {
    return {static_cast<std::uint8_t>(4 * p.x), static_cast<std::uint8_t>(4 * p.y), static_cast<std::uint8_t>(4 * p.z)};
}

// The grid points with coordinates below the given limits.
constexpr GridBits grid_points_below(int x_end, int y_end, int z_end) {
    GridBits bits = 0;
    for (int z = 0; z < z_end; ++z)
        for (int y = 0; y < y_end; ++y)
            for (int x = 0; x < x_end; ++x) bits |= GridBits{1} << (x + 5 * y + 25 * z);
    return bits;
}
// The points on the lower side of the brick, by axis.
inline constexpr std::array<GridBits, 3> kLowerSides{grid_points_below(1, 5, 5), grid_points_below(5, 1, 5),
                                                     grid_points_below(5, 5, 1)};
// The first points of the edges along each axis.
inline constexpr std::array<GridBits, 3> kEdgeStarts{grid_points_below(4, 5, 5), grid_points_below(5, 4, 5),
                                                     grid_points_below(5, 5, 4)};

struct BrickCells {
    std::array<std::uint16_t, kCellsPerBrick> first; // first vertex of each cell within the brick, or kNoVertex
    std::array<std::uint64_t, 2> inside;             // sign of each of the 125 grid points
    std::uint64_t recorded;                          // bit per cell: has a record; other crossed cells have one vertex
    std::uint32_t first_record;                      // in the subtree
    std::uint32_t first_vertex;                      // in the subtree, later in the mesh
    std::uint32_t walls;                             // index into SubtreeCells::walls, or kNoWalls
    bool crossed;                                    // if false, no other member is valid

    [[nodiscard]] GridBits grid_bits() const { return GridBits{inside[1]} << 64 | inside[0]; }
};

// Vertices as a structure of arrays. The arrays are longer than `count`, since projection writes whole vectors.
struct SurfaceVertices : VertexArrays {
    std::size_t count = 0;

    void reserve(std::size_t more);
};

// Copies `count` vertices from index `begin` of `from` to index `at` of arrays like those of a mesh.
template <class Arrays>
void copy_vertices(const VertexArrays& from, std::size_t begin, Arrays& to, std::size_t at, std::size_t count) {
    std::copy_n(from.positions.data() + begin, count, to.positions.data() + at);
    std::copy_n(from.normals.data() + begin, count, to.normals.data() + at);
    std::copy_n(from.radii.data() + begin, count, to.radii.data() + at);
    std::copy_n(from.branches.data() + begin, count, to.branches.data() + at);
    if constexpr (requires { to.dominance; })
        std::copy_n(from.dominance.data() + begin, count, to.dominance.data() + at);
}

struct SampleCounts {
    std::uint64_t evaluations = 0; // kernels, one per segment and point
    std::uint64_t samples = 0;     // points at which the field was sampled
};

// Sets of edges of a brick, by their first points. `edges`: edges with a wall, by axis. `left_out`: crossings of specks
// (specks.h), which get no polygon; by axis, then by axis those of the upper ends of edges with a wall.
struct BrickWalls {
    std::array<GridBits, 3> edges{};
    std::array<GridBits, 6> left_out{};
};

// The data of all bricks of one subtree.
struct SubtreeCells {
    const SurfaceVertices* vertices = nullptr; // block with the subtree's vertices, until they are copied to the mesh
    std::size_t first_vertex = 0, vertex_count = 0;
    std::vector<CellRecord> records;
    std::vector<ArcVertex> arc_vertices;
    std::vector<BrickWalls> walls;
    // CellRecord::circuit_of for upper ends of edges.
    std::vector<std::array<std::uint8_t, kQuarterPoints>> upper_circuits;
    std::vector<std::uint32_t> walled_bricks; // bricks with walls
    SampleCounts counts;
    // Whether the result depends on bricks next to the subtree; and on bricks next to these.
    bool looked_beyond = false, looked_far = false;

    void add_arc(const FaceArc& arc, std::size_t vertex) {
        arc_vertices.push_back({arc.face, arc.first, static_cast<std::uint16_t>(vertex)});
        arc_vertices.push_back({arc.face, arc.second, static_cast<std::uint16_t>(vertex)});
    }
};

// The record of a cell that has one.
inline const CellRecord& record_of(const BrickCells& brick, const SubtreeCells& subtree, int cell) {
    const int before = std::popcount(brick.recorded & ((std::uint64_t{1} << cell) - 1));
    return subtree.records[brick.first_record + static_cast<std::uint32_t>(before)];
}
// The circuit of a recorded cell through a crossing, or kNoCircuit.
inline std::uint8_t circuit_of(const CellRecord& record, const SubtreeCells& subtree, int crossing) {
    if (crossing < kUpperEnd) return record.circuit_of[static_cast<std::size_t>(crossing)];
    return record.walls == kNoWalls
               ? kNoCircuit
               : subtree.upper_circuits[record.walls][static_cast<std::size_t>(crossing - kUpperEnd)];
}

// For a cell with walls, one bit per circuit: whether all of its crossings are at walls.
inline std::uint64_t circuits_along_walls(const CellRecord& record, const SubtreeCells& subtree) {
    const auto& upper = subtree.upper_circuits[record.walls];
    std::uint64_t seen = 0, elsewhere = 0;
    for (std::size_t m = 0; m < kQuarterPoints; ++m) {
        const std::uint8_t lower = record.circuit_of[m];
        if (lower == kNoCircuit) continue;
        seen |= std::uint64_t{1} << lower;
        if (upper[m] == kNoCircuit)
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
    std::vector<std::unique_ptr<SurfaceVertices>> vertices, spare; // blocks in use, and free blocks

    void reuse_vertices(); // frees all blocks; call it after their vertices were copied to the mesh

    [[nodiscard]] bool is_recorded(std::uint32_t brick, int cell) const {
        return (cells[brick].recorded >> cell & 1U) != 0;
    }
    [[nodiscard]] const CellRecord& record(const Brick& brick, std::uint32_t index, int cell) const;
    // The vertex of the circuit through a crossing (an index into the mesh once first_vertex is one); kAbsent if a wall
    // has no circuit there.
    static constexpr std::uint32_t kAbsent = 0xFFFFFFFFU;
    [[nodiscard]] std::uint32_t vertex(const Brick& brick, std::uint32_t index, int cell, int crossing) const;
    // The walls of a brick that has some.
    [[nodiscard]] const BrickWalls& walls(const Brick& brick, std::uint32_t index) const {
        return subtrees[brick.subtree].walls[cells[index].walls];
    }
};

// Samples the bricks of some subtrees, traces the circuits of their cells and places the vertices on the surface. The
// neighbourhoods of the subtrees must be known. Incomplete if cancelled.
void fill_subtrees(const field::Field& field, const Octree& octree, std::span<const std::uint32_t> subtrees,
                   SurfaceCells& surface, const JobRange& job);

// Whether some polygon of the subtree may have vertices in changed subtrees: the surface crosses the boundary to one.
[[nodiscard]] bool reaches_beyond(const Octree& octree, const SurfaceCells& surface, std::uint32_t subtree,
                                  const OctreeChanges& changes);

// Projects guesses in the current brick of `field` onto the surface and appends them to `vertices`. Returns the number
// of kernels evaluated. `owned`: the owners of guesses if vessels are kept apart in the brick.
std::uint64_t append_projected(field::BrickField& field, field::Projection& guesses, SurfaceVertices& vertices,
                               std::span<const field::OwnedGuess> owned = {});

[[nodiscard]] field::GridAxes grid_axes(const Lattice& lattice, const Brick& brick);
// The coordinates of the brick's points at quarter-cell spacing, mm.
[[nodiscard]] field::LatticeAxes lattice_axes(const Lattice& lattice, const Brick& brick);

} // namespace ramus::mesh::bricks
