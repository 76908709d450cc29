// Untangling: removes self-intersections of a surface that are limited to a few triangles. Vertices there are pushed
// inward and smoothed until no triangles intersect, so that the surface bounds a solid for simulations.
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
    std::size_t found = 0; // pairs of triangles that intersected before, beyond their common corners
    std::size_t left = 0;  // pairs that intersect afterwards
    // False: not all pairs were counted, since somewhere too many triangles may intersect. That happens if cells are
    // larger than vessels.
    bool looked_at_all = true;
    std::vector<glm::vec3> places; // where pairs are left, mm, RAS

    // Adds the result for another part of a surface.
    void add(const Untangled& part) {
        found += part.found, left += part.left;
        looked_at_all = looked_at_all && part.looked_at_all;
        places.insert(places.end(), part.places.begin(), part.places.end());
    }
};

// Finds intersecting triangles near folds (folds.h) and in `places` (boxes around walls, from polygonize()), and moves
// their vertices inward and toward the mean of their neighbours until none intersect. The surface must be closed, with
// normals and radii. A vertex moves by at most half of the vessel's radius. Triangles and normals do not change, so the
// surface stays closed.
//
// Each place is repaired by itself, in time proportional to its triangles. If some pairs are left after a fixed number
// of rounds, the state with the fewest pairs is kept. A place with too many pairs does not change. If cancelled, the
// surface does not change.
Untangled untangle(TriangleMesh& mesh, std::span<const TriangleBox> places, Job& job);

} // namespace ramus::mesh
