// Patches: what of a surface lies around places where it meets itself, each as a small mesh of its own.
#pragma once

#include "core/base/grouped.h"
#include "core/mesh/triangle_mesh.h"
#include "core/mesh/untangle/intersecting_triangles.h"
#include "core/mesh/untangle/triangle_boxes.h"

#include <cstdint>
#include <span>
#include <vector>

namespace ramus::mesh {

// Pairs of a surface's triangles, and the triangles around them: as far as some times the longest of a pair's sides.
struct IntersectionPlace {
    std::vector<TrianglePair> pairs;      // ascending
    std::vector<std::uint32_t> triangles; // ascending
};
// In order of their first pairs; no two have a triangle in common.
[[nodiscard]] std::vector<IntersectionPlace> intersection_places(const TriangleMesh& mesh, const TriangleBoxes& boxes,
                                                                 std::span<const TrianglePair> pairs);

struct Patch {
    std::vector<std::uint32_t> vertices; // of the surface, by their numbers here
    std::vector<glm::vec3> positions;    // mm
    std::vector<glm::uvec3> triangles;   // of vertices by their numbers here
    std::vector<TrianglePair> pairs;     // of these triangles, that the patch is around
    Grouped<std::uint32_t> neighbours;   // of each vertex
    std::vector<std::uint8_t> has_all;   // whether all triangles at a vertex are here, by vertex
};
[[nodiscard]] Patch patch_around(const TriangleMesh& mesh, const IntersectionPlace& place);

} // namespace ramus::mesh
