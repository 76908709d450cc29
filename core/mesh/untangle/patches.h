// Patches: what of a surface lies around places where it meets itself, as a small mesh of its own.
#pragma once

#include "core/base/grouped.h"
#include "core/base/job.h"
#include "core/mesh/triangle_mesh.h"
#include "core/mesh/untangle/meeting_triangles.h"
#include "core/mesh/untangle/triangle_boxes.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace ramus::mesh {

struct Patches {
    std::vector<std::uint32_t> vertices; // of the surface, by their numbers here
    std::vector<glm::vec3> positions;    // mm
    std::vector<glm::uvec3> triangles;   // of vertices by their numbers here
    std::vector<TrianglePair> pairs;     // of these triangles, that the patches are around
    Grouped<std::uint32_t> neighbours;   // of each vertex
    std::vector<std::uint8_t> has_all;   // whether all triangles at a vertex are here, by vertex
};

// Around pairs of a surface's triangles, as far as some times the longest of their sides. None where that is more
// triangles than `most`, or the job is cancelled.
[[nodiscard]] std::optional<Patches> patches_around(const TriangleMesh& mesh, const TriangleBoxes& boxes,
                                                    std::span<const TrianglePair> pairs, std::size_t most, Job& job);

} // namespace ramus::mesh
