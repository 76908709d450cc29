// EdgePolygons: builds the polygon around one crossed minimal edge in the general case: at a brick's boundary, between
// cells of different size, around cells with several vertices, and at walls. join_triangles.cpp handles the simple
// case.
#pragma once

#include "core/field/separation.h"
#include "core/mesh/polygonize/cells/brick_cells.h"

#include <array>
#include <glm/vec4.hpp>
#include <memory>
#include <oneapi/tbb/enumerable_thread_specific.h>
#include <span>
#include <utility>
#include <vector>

namespace ramus::mesh::bricks {

// Marks vertices that joining adds: their indices are relative to the subtree until their indices in the mesh are
// known.
inline constexpr std::uint32_t kAddedBit = 0x80000000U;

struct JoinedSubtree {
    std::vector<glm::uvec4> quads; // counter-clockwise; divided later
    std::vector<glm::uvec3> triangles;
    SurfaceVertices added;
    // Vertices on edges of the current brick, which finish() projects together.
    field::Projection guesses;
    std::vector<field::OwnedGuess> owned;
    std::vector<field::LatticePoint> inside; // by guess: the end of its edge inside the vessel

    [[nodiscard]] std::size_t triangle_count() const { return 2 * quads.size() + triangles.size(); }
    // Writes all triangles, first those of the quads. `vertices`: all vertices of the mesh. `first_added`: the index of
    // the first added vertex.
    void write_triangles(const VertexSpan& vertices, std::uint64_t first_added, std::span<glm::uvec3> out) const;
    void clear();
};

// Divides each quad (indices into `vertices`, counter-clockwise) along the better one of its diagonals. Writes two
// triangles per quad.
void cut_quads(const VertexSpan& vertices, std::span<const glm::uvec4> quads, std::span<glm::uvec3> triangles);

class EdgePolygons {
public:
    // Keeps references to all arguments.
    EdgePolygons(const field::Field& field, const Octree& octree, const SurfaceCells& surface,
                 const VertexSpan& vertices)
        : octree_(octree), surface_(surface), vertices_(vertices), fields_([&] { return field.in_brick(); }) {}

    // Adds the polygon around the edge of brick `index` from grid point `point` along `axis`. `first_inside`: whether
    // its first end is inside. Adds nothing if another brick is responsible for the edge.
    void add(std::uint32_t index, int axis, glm::ivec3 point, bool first_inside, JoinedSubtree& out) const;
    // Adds the polygons around an edge with a wall: one for the vessel of its lower end, one for that of its upper end.
    // `left_out`: bit 0 and 1 skip them.
    void add_wall(std::uint32_t index, int axis, glm::ivec3 point, unsigned left_out, JoinedSubtree& out) const;
    // Projects the vertices on edges onto the surface. Must be called after the edges of a brick.
    void finish(std::uint32_t index, JoinedSubtree& out) const;

    [[nodiscard]] const BrickWalls& walls(std::uint32_t index) const {
        return surface_.walls(octree_.bricks[index], index);
    }

private:
    // One of the cells around an edge.
    struct Around {
        std::uint32_t vertex = 0;
        std::uint32_t brick = 0;
        std::int32_t cell = 0;
        std::int32_t level = 0;
        std::int32_t crossing = 0; // the edge's crossing in the numbering of the cell
        bool recorded = false;
    };

    struct Ring {
        std::array<Around, 4> cells; // counter-clockwise about the axis
        std::size_t count = 0;       // 0: another brick is responsible for the edge
        bool open = false;           // a wall ends there: some cell has no vertex; the gap is after the last entry
        [[nodiscard]] std::span<const Around> span() const { return std::span(cells).first(count); }
    };
    // A crossed edge, and its end inside the vessel.
    struct Edge {
        std::uint32_t brick = 0;
        int axis = 0;
        glm::ivec3 point{0};
        bool upper = false; // whether the upper end is the one inside
        bool walled = false;
    };
    [[nodiscard]] Ring ring_around(const Edge& edge) const;
    [[nodiscard]] Around same_level(std::uint32_t brick, const Edge& edge, glm::ivec3 cell, int side) const;
    [[nodiscard]] Around coarser(std::uint32_t brick, const Edge& edge, glm::ivec3 cell) const;
    [[nodiscard]] std::uint32_t arc_vertex(const Around& a, const Around& b) const;
    [[nodiscard]] glm::ivec3 low_corner(const Around& a) const;
    // Which diagonals may divide the polygon of four cells: that from the first cell, that from the second cell.
    [[nodiscard]] std::pair<bool, bool> diagonals_of(std::span<const Around> ring, const Edge& edge) const;
    // A polygon, including the vertices of arcs between the cells. `extra`: whether it has such vertices.
    struct Polygon {
        std::array<std::uint32_t, 8> vertices{};
        std::size_t count = 0;
        bool extra = false;
        [[nodiscard]] std::span<const std::uint32_t> span() const { return std::span(vertices).first(count); }
    };
    [[nodiscard]] Polygon polygon_of(std::span<const Around> ring, bool open) const;
    void add_polygon(const Ring& ring, const Edge& edge, JoinedSubtree& out) const;
    void emit(std::span<const Around> ring, const Edge& edge, JoinedSubtree& out) const;
    std::uint32_t add_centre(const Polygon& polygon, const Edge& edge, JoinedSubtree& out) const;
    void find_owners(field::Separation& separation, std::uint32_t index, JoinedSubtree& out) const; // of guesses
    std::uint32_t add_fan(const Ring& ring, const Edge& edge, JoinedSubtree& out) const;            // its centre
    static void emit_fan(std::uint32_t centre, const Polygon& polygon, bool open, JoinedSubtree& out);

    const Octree& octree_;
    const SurfaceCells& surface_;
    VertexSpan vertices_;
    mutable tbb::enumerable_thread_specific<std::unique_ptr<field::BrickField>> fields_; // each thread's
};

} // namespace ramus::mesh::bricks
