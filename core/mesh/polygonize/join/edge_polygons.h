// Edge polygons: the polygon around one minimal edge that the surface crosses, in general: at a brick's boundary,
// between cells of different size, where cells have several vertices. What lies inside one brick is join_triangles'
// own.
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

// Marks indices of vertices that joining itself adds; they are numbered within the subtree until their indices in the
// mesh are known.
inline constexpr std::uint32_t kAddedBit = 0x80000000U;

struct JoinedSubtree {
    std::vector<glm::uvec4> quads; // counter-clockwise; their diagonals are chosen later
    std::vector<glm::uvec3> triangles;
    SurfaceVertices added;
    // Of the brick that is being joined: vertices on edges, to be moved onto the surface all at once.
    field::Projection guesses;
    std::vector<field::OwnedGuess> owned;
    std::vector<field::LatticePoint> inside; // by guess, the end of its edge that looks at the surface

    [[nodiscard]] std::size_t triangle_count() const { return 2 * quads.size() + triangles.size(); }
    // Writes them all, first those of the quads. `vertices`: those joined; `first_added`: the index of the first added.
    void write_triangles(const VertexSpan& vertices, std::uint64_t first_added, std::span<glm::uvec3> out) const;
    void clear();
};

// Cuts quads (of `vertices`, counter-clockwise) along the better of their two diagonals: writes two triangles for each
// to `triangles`.
void cut_quads(const VertexSpan& vertices, std::span<const glm::uvec4> quads, std::span<glm::uvec3> triangles);

class EdgePolygons {
public:
    // Refers to all that it is given.
    EdgePolygons(const field::Field& field, const Octree& octree, const SurfaceCells& surface,
                 const VertexSpan& vertices)
        : octree_(octree), surface_(surface), vertices_(vertices), fields_([&] { return field.in_brick(); }) {}

    // The edge of brick `index` from grid point `point` along `axis`, whose first end is inside or not. Adds nothing
    // when the edge is another brick's to join.
    void add(std::uint32_t index, int axis, glm::ivec3 point, bool first_inside, JoinedSubtree& out) const;
    // The same of an edge that a wall goes through: one polygon for each vessel, that of its lower end and that of its
    // upper one. Without those left out, a bit each.
    void add_wall(std::uint32_t index, int axis, glm::ivec3 point, unsigned left_out, JoinedSubtree& out) const;
    // After the edges of a brick, moves the vertices that polygons got on edges onto the surface.
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
        std::int32_t crossing = 0; // as the cell names it
        std::int32_t place = 0;    // of four around the edge, the first that it takes
        bool recorded = false;
    };

    struct Ring {
        std::array<Around, 4> cells; // counter-clockwise about the axis
        std::size_t count = 0;       // 0: another brick's to join
        bool open = false;           // a wall ends there: in some cells it has no vertex, which would follow the last
        [[nodiscard]] std::span<const Around> span() const { return std::span(cells).first(count); }
        void begin_after_gap(); // so that what is missing follows the last
    };
    // The edge, and which end of it looks at the surface.
    struct Edge {
        std::uint32_t brick = 0;
        int axis = 0;
        glm::ivec3 point{0};
        bool upper = false; // the inside's end
        bool walled = false;
    };
    [[nodiscard]] Ring ring_around(const Edge& edge) const;
    [[nodiscard]] Around same_level(std::uint32_t brick, const Edge& edge, glm::ivec3 cell, int side) const;
    [[nodiscard]] Around coarser(std::uint32_t brick, const Edge& edge, glm::ivec3 cell) const;
    [[nodiscard]] std::uint32_t arc_vertex(const Around& a, const Around& b) const;
    [[nodiscard]] glm::ivec3 low_corner(const Around& a) const;
    // Which diagonals of four cells may cut their polygon: from the first, from the second.
    [[nodiscard]] std::pair<bool, bool> diagonals_of(std::span<const Around> ring, const Edge& edge) const;
    // The polygon with the vertices of arcs between the cells. `extra`: it has such.
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
