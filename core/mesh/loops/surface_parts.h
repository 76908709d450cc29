// SurfaceParts: divides a closed surface into connected parts near given triangles and the rest, and finds the parts
// that loops pass through. A loop lies within a part, within the rest, or passes through several of them. Whether a
// loop passes through a part follows from the part alone, and from which of its borders are connected beyond the part.
//
// Parts and pieces of the rest meet along closed lines of edges, the borders. Borders have no common vertices: near a
// vertex of two borders, all triangles are added to the part. Parts, pieces of the rest and borders form a graph. On a
// surface without loops every border divides the surface, so this graph is a tree. Two borders of a part are connected
// beyond it if they lie on a cycle of the graph, that is, in one biconnected component.
// Arrays are in the memory of the surface (TriangleMesh::memory()), since there may be as many parts as vessels meet.
#pragma once

#include "core/base/bounds.h"
#include "core/base/grouped.h"
#include "core/base/large_array.h"
#include "core/mesh/connectivity.h"
#include "core/mesh/triangle_mesh.h"
#include "core/mesh/untangle/triangle_boxes.h"
#include "core/tree/prepare.h"

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>

namespace ramus::mesh {

struct PartBorder {
    std::span<const std::uint32_t> vertices; // in the order of the part's triangles
    // Borders of one part with the same number are connected beyond it.
    std::uint32_t connected = 0;
};

struct SurfacePart {
    std::span<const std::uint32_t> triangles; // ascending
    std::span<const PartBorder> borders;
    bool has_loops = false; // whether loops pass through it
};

// What to compute for the rest: only how it connects the parts, or also which of its pieces have loops.
enum class Rest : std::uint8_t { kConnections, kLoops };

class SurfaceParts {
public:
    // Divides a closed surface in which every vertex belongs to a triangle. `boxes`: the boxes of the surface. `near`:
    // the triangles of the parts, ascending. Takes 20 ns for each triangle (40 ns with Rest::kLoops), and more for
    // triangles in `near`. What it keeps is in the memory of the surface.
    SurfaceParts(const TriangleMesh& mesh, const TriangleBoxes& boxes, LargeArray<std::uint32_t> near,
                 Rest rest = Rest::kConnections);
    SurfaceParts(const SurfaceParts&) = delete; // parts are views
    SurfaceParts(SurfaceParts&&) = default;
    SurfaceParts& operator=(const SurfaceParts&) = delete;
    SurfaceParts& operator=(SurfaceParts&&) = default;
    ~SurfaceParts() = default;

    // In order of their first triangles.
    [[nodiscard]] std::span<const SurfacePart> parts() const { return parts_; }
    [[nodiscard]] const Connectivity& of_surface() const { return of_surface_; }
    // With Rest::kLoops: the triangles of the pieces of the rest that contain loops, ascending.
    [[nodiscard]] const LargeArray<std::uint32_t>& rest_with_loops() const { return rest_with_loops_; }

private:
    Grouped<std::uint32_t> triangles_;          // by part
    LargeArray<std::uint32_t> border_vertices_; // border by border
    Grouped<PartBorder> borders_;               // by part
    LargeArray<SurfacePart> parts_;
    Connectivity of_surface_;
    LargeArray<std::uint32_t> rest_with_loops_;
};

// The triangles in or near `places` (mm), ascending. `boxes`: the boxes of the surface.
[[nodiscard]] LargeArray<std::uint32_t> triangles_at(const TriangleMesh& mesh, const TriangleBoxes& boxes,
                                                     std::span<const Bounds<glm::vec3>> places);
// The triangles around the given ones, up to four times the longest side of each, ascending.
[[nodiscard]] LargeArray<std::uint32_t> triangles_around(const TriangleMesh& mesh, const TriangleBoxes& boxes,
                                                         std::span<const std::uint32_t> triangles);
// The triangles whose corners belong to different branches, ascending.
[[nodiscard]] LargeArray<std::uint32_t> triangles_between_branches(const TriangleMesh& mesh);
// The triangles of `between_branches` whose branches have no common point in the tree of the surface.
[[nodiscard]] LargeArray<std::uint32_t> foreign_triangles(const TriangleMesh& mesh, const tree::PreparedTree& tree,
                                                          std::span<const std::uint32_t> between_branches);

} // namespace ramus::mesh
