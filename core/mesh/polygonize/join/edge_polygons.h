// Edge polygons: the polygon around one minimal edge that the surface crosses, in general: at a brick's boundary,
// between cells of different size, where cells have several vertices. What lies inside one brick is join_triangles'
// own.
#pragma once

#include "core/mesh/polygonize/cells/brick_cells.h"

#include <glm/vec4.hpp>
#include <span>
#include <vector>

namespace ramus::mesh::bricks {

// Marks indices of vertices that joining itself adds; they are numbered within the subtree until their indices in the
// mesh are known.
inline constexpr std::uint32_t kAddedBit = 0x80000000U;

struct JoinedSubtree {
    std::vector<glm::uvec4> quads; // counter-clockwise; their diagonals are chosen later
    std::vector<glm::uvec3> triangles;
    SurfaceVertices added;

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
    EdgePolygons(const field::Field& field, const Octree& octree, const SurfaceCells& surface,
                 const VertexSpan& vertices)
        : field_(field), octree_(octree), surface_(surface), vertices_(vertices) {}

    // The edge of brick `index` from grid point `point` along `axis`, whose first end is inside or not. Adds nothing
    // when the edge is another brick's to join.
    void add(std::uint32_t index, int axis, glm::ivec3 point, bool first_inside, JoinedSubtree& out) const;

private:
    // One of the cells around an edge.
    struct Around {
        std::uint32_t vertex = 0;
        std::uint32_t brick = 0;
        std::int32_t cell = 0;
        std::int32_t level = 0;
        std::int32_t edge = 0; // the minimal edge's midpoint on the cell's quarter grid
        bool recorded = false;
    };

    [[nodiscard]] Around same_level(std::uint32_t brick, int axis, glm::ivec3 cell, int side) const;
    [[nodiscard]] Around coarser(std::uint32_t index, std::uint32_t brick, int axis, glm::ivec3 point,
                                 glm::ivec3 cell) const;
    [[nodiscard]] std::uint32_t arc_vertex(const Around& a, const Around& b) const;
    [[nodiscard]] glm::ivec3 low_corner(const Around& a) const;
    void emit(std::span<const Around> ring, int axis, JoinedSubtree& out, std::uint32_t index, glm::ivec3 point) const;
    void emit_fan(std::span<const std::uint32_t> polygon, int axis, JoinedSubtree& out, std::uint32_t index,
                  glm::ivec3 point) const;

    field::Field field_;
    const Octree& octree_;
    const SurfaceCells& surface_;
    VertexSpan vertices_;
};

} // namespace ramus::mesh::bricks
