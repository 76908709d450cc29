// Untangling: a surface that goes through itself here and there, within a few triangles, is drawn smooth there until it
// does not. So it bounds a solid that simulations can take.
#pragma once

#include "core/base/job.h"
#include "core/mesh/triangle_mesh.h"
#include "core/mesh/untangle/triangle_boxes.h"

#include <span>

namespace ramus::mesh {

struct Untangled {
    std::size_t found = 0; // pairs of triangles that met beyond the corners that they share
    std::size_t left = 0;  // of these, and of what has come to meet
    // False: too many triangles are suspected to meet others, as with cells larger than vessels. Nothing is moved, and
    // found and left count none of them.
    bool looked_at_all = true;

    // Of another part of a surface.
    void add(const Untangled& part) {
        found += part.found, left += part.left;
        looked_at_all = looked_at_all && part.looked_at_all;
    }
};

// Looks for triangles that meet, near folds (folds.h) and at `places` (as polygonize() has them), and moves their
// vertices toward the middle of their neighbours until none meet, at most by half of the vessel's radius; normals stay.
// Where that does not help in some rounds, what met least stays; where very much meets, as with cells larger than
// vessels, all stays. Of a closed surface with normals and radii. If cancelled, the surface is as it was.
Untangled untangle(TriangleMesh& mesh, std::span<const TriangleBox> places, Job& job);

} // namespace ramus::mesh
