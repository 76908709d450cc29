// Untangling: a surface that goes through itself here and there, within a few triangles, is pushed inward and drawn
// smooth there until it does not. So it bounds a solid that simulations can take.
#pragma once

#include "core/base/job.h"
#include "core/mesh/triangle_mesh.h"
#include "core/mesh/untangle/triangle_boxes.h"

#include <cstddef>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace ramus::mesh {

struct Untangled {
    std::size_t found = 0; // pairs of triangles that met beyond the corners that they share
    std::size_t left = 0;  // of these, and of what has come to meet
    // False: somewhere too many triangles are suspected to meet others, as with cells larger than vessels. There not
    // all are counted.
    bool looked_at_all = true;
    std::vector<glm::vec3> places; // where pairs are left, mm, RAS

    // Of another part of a surface.
    void add(const Untangled& part) {
        found += part.found, left += part.left;
        looked_at_all = looked_at_all && part.looked_at_all;
        places.insert(places.end(), part.places.begin(), part.places.end());
    }
};

// Looks for triangles that meet, near folds (folds.h) and at `places` (as polygonize() has them), and moves their
// vertices inward and toward the middle of their neighbours until none meet, at most by half of the vessel's radius;
// normals stay.
// Each place by itself, in time as its triangles. Where that does not help in some rounds, what met least stays; where
// very much meets, as with cells larger than vessels, all stays there. Of a closed surface with normals and radii. If
// cancelled, the surface is as it was.
Untangled untangle(TriangleMesh& mesh, std::span<const TriangleBox> places, Job& job);

} // namespace ramus::mesh
