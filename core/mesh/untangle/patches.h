// Patches: groups intersecting pairs of triangles into places, and copies the surface around each place as a small
// mesh.
#pragma once

#include "core/base/grouped.h"
#include "core/mesh/triangle_mesh.h"
#include "core/mesh/untangle/intersecting_triangles.h"
#include "core/mesh/untangle/triangle_boxes.h"

#include <cstdint>
#include <span>
#include <vector>

namespace ramus::mesh {

// Pairs of intersecting triangles, and the triangles around them, up to four times the longest side of each pair.
struct IntersectionPlace {
    std::vector<TrianglePair> pairs;      // ascending
    std::vector<std::uint32_t> triangles; // ascending
};
// The places of all pairs, in the order of their first pairs. No two places have a common triangle.
[[nodiscard]] std::vector<IntersectionPlace> intersection_places(const TriangleMesh& mesh, const TriangleBoxes& boxes,
                                                                 std::span<const TrianglePair> pairs);

struct Patch {
    std::vector<std::uint32_t> vertices; // by vertex of the patch: the vertex of the surface, ascending
    std::vector<glm::vec3> positions;    // by vertex of the patch, mm
    std::vector<glm::uvec3> triangles;   // with vertices of the patch
    std::vector<TrianglePair> pairs;     // with triangles of the patch
    Grouped<std::uint32_t> neighbours;   // by vertex: the vertices connected to it by an edge
    std::vector<std::uint8_t> has_all;   // by vertex: whether all of its triangles are in the patch
};
[[nodiscard]] Patch patch_around(const TriangleMesh& mesh, const IntersectionPlace& place);

} // namespace ramus::mesh
