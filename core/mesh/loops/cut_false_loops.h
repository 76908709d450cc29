// Cuts false loops: handles of a surface that correspond to no cycle of its tree. Field and cells leave some where
// vessels diverge or pass each other within a cell or two.
#pragma once

#include "core/base/job.h"
#include "core/mesh/loops/surface_parts.h"
#include "core/mesh/triangle_mesh.h"
#include "core/tree/prepare.h"

#include <algorithm>
#include <cstddef>
#include <glm/vec3.hpp>
#include <vector>

namespace ramus::mesh {

struct CutLoops {
    std::size_t cut = 0; // number of loops cut
    // If loops remain: places where the surface still connects vessels that the tree does not; mm, RAS.
    std::vector<glm::vec3> left;
    double lacked_bytes = 0.0; // the largest memory needed for a part that was skipped for lack of memory

    void add(const CutLoops& more) {
        cut += more.cut;
        left.insert(left.end(), more.left.begin(), more.left.end());
        lacked_bytes = std::max(lacked_bytes, more.lacked_bytes);
    }
};

// Cuts a closed surface until it has no more loops than its tree. Each cut follows the shortest closed line of edges
// that does not divide the surface and that no axis runs through: around a connection that the tree does not have, or
// around the hole next to it. Holes are filled only if the tree has no cycles, since otherwise the hole may be a cycle
// of the tree. A loop stays if no such line is short.
//
// Searches parts of the surface that loops pass through, each by itself: first at walls between vessels; then where
// branches meet that do not meet in the tree; then where branches meet that do; then parts within one branch; and last
// the whole surface, if it is small. `tree`: the tree of the surface. `at_walls`: the parts at walls. Every vertex must
// belong to a triangle. If cancelled, the remaining searches cut nothing. Skips parts that need more than
// `memory_bytes`.
[[nodiscard]] CutLoops cut_false_loops(TriangleMesh& mesh, const tree::PreparedTree& tree, const SurfaceParts& at_walls,
                                       double memory_bytes, Job& job);

} // namespace ramus::mesh
