// SurfaceParts: what of a closed surface lies near certain places, in parts that hang together, and how these hang
// together with the rest. Loops of a surface lie within such a part, within the rest, or lead through several: whether
// any lead through a part is told by the part alone and by which of its borders are connected beyond it.
//
// Parts and pieces of the rest meet along closed lines of edges, borders, that have no vertex in common: where two
// would, all triangles there are near. They and their borders are a graph. Every border of a surface without loops
// parts it, so that the graph of such a surface is a tree, whatever is near. Two borders of a part are connected beyond
// it where they lie on a cycle, which is so where they are of one biconnected component.
#pragma once

#include "core/base/bounds.h"
#include "core/mesh/connectivity.h"
#include "core/mesh/triangle_mesh.h"
#include "core/mesh/untangle/triangle_boxes.h"
#include "core/tree/prepare.h"

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <utility>
#include <vector>

namespace ramus::mesh {

using BorderEdge = std::pair<std::uint32_t, std::uint32_t>; // vertices, as the part's triangle has them

struct PartBorder {
    std::vector<std::uint32_t> vertices; // in the order in which the part's triangles have them
    // Borders of one part with the same number are connected beyond it.
    std::uint32_t connected = 0;
};

struct SurfacePart {
    std::vector<std::uint32_t> triangles; // ascending
    std::vector<PartBorder> borders;
    bool has_loops = false; // some lead through it
};

// What of the rest is asked for, besides how it connects the parts.
enum class Rest : std::uint8_t { kConnections, kLoops };

class SurfaceParts {
public:
    // Of a closed surface in which all vertices have triangles, its boxes, and triangles that are near, ascending.
    // Takes 20 ns for each triangle (twice that with the loops of the rest), and more for each that is near.
    SurfaceParts(const TriangleMesh& mesh, const TriangleBoxes& boxes, std::vector<std::uint32_t> near,
                 Rest rest = Rest::kConnections);

    // In order of their first triangles.
    [[nodiscard]] std::span<const SurfacePart> parts() const { return parts_; }
    [[nodiscard]] const Connectivity& of_surface() const { return of_surface_; }
    // The triangles of those pieces of the rest that have loops within, ascending; Rest::kLoops.
    [[nodiscard]] const std::vector<std::uint32_t>& rest_with_loops() const { return rest_with_loops_; }

private:
    void take_parts(std::span<const std::uint32_t> near, std::span<const BorderEdge> border);
    void find_rest(std::span<const std::uint32_t> near, std::span<const BorderEdge> border, Rest rest);
    void find_loops(std::span<const std::uint32_t> beyond, std::size_t rest);

    const TriangleMesh& mesh_;
    std::vector<SurfacePart> parts_;
    Connectivity of_surface_;
    std::vector<std::uint32_t> rest_with_loops_;
};

// All of a surface as one part, without a border.
[[nodiscard]] SurfacePart whole_part(const TriangleMesh& mesh);

// Triangles in or beside places, mm; ascending. `boxes`: of the surface.
[[nodiscard]] std::vector<std::uint32_t> triangles_at(const TriangleBoxes& boxes,
                                                      std::span<const Bounds<glm::vec3>> places);
// Triangles around some, as far as some times the longest of their sides; ascending.
[[nodiscard]] std::vector<std::uint32_t> triangles_around(const TriangleMesh& mesh, const TriangleBoxes& boxes,
                                                          std::span<const std::uint32_t> triangles);
// Triangles whose corners belong to different branches; ascending.
[[nodiscard]] std::vector<std::uint32_t> triangles_between_branches(const TriangleMesh& mesh);
// Of these the ones between branches that have no point of the tree in common. `tree`: what the surface was made of.
[[nodiscard]] std::vector<std::uint32_t> foreign_triangles(const TriangleMesh& mesh, const tree::PreparedTree& tree,
                                                           std::span<const std::uint32_t> between_branches);

} // namespace ramus::mesh
