// False loops: those of a surface that its tree has no cycle for. Where vessels part or pass each other within a cell
// or two, the last of them are left by field and cells; here the surface is cut there.
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
    std::size_t cut = 0;
    // Where the surface still connects what the tree does not, if it has other loops; mm, RAS.
    std::vector<glm::vec3> left;
    double lacked_bytes = 0.0; // most that looking at a part would have taken, where memory did not suffice

    void add(const CutLoops& more) {
        cut += more.cut;
        left.insert(left.end(), more.left.begin(), more.left.end());
        lacked_bytes = std::max(lacked_bytes, more.lacked_bytes);
    }
};

// Cuts a closed surface, of which each vertex has triangles, until it has no more loops than its tree, along the
// shortest line each time that goes around no vessel: around a connection that the tree has not, or around the hole
// beside it. Holes are filled only where the tree has no cycle at all, or one of its own might be. Where no such line
// is short, a loop stays. Looks in parts of the surface that loops lead through, each by itself: at walls between
// vessels, then where branches meet that do not in the tree, or that do; in the whole only where that is small. `tree`:
// what the surface was made of; `at_walls`: its parts there. Cuts nothing if cancelled, and in no part where it would
// take more than `memory_bytes`.
[[nodiscard]] CutLoops cut_false_loops(TriangleMesh& mesh, const tree::PreparedTree& tree, const SurfaceParts& at_walls,
                                       double memory_bytes, Job& job);

} // namespace ramus::mesh
