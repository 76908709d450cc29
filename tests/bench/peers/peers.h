// What the comparison with other programs' libraries has in common: a scene goes in, a mesh comes out, and all that
// happens in between is timed. What a peer's mesh looks like inside is its own affair; for checks it is unfolded into a
// plain one when the clock has stopped.
#pragma once

#include "core/tree/prepare.h"

#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

namespace ramus::peers {

struct Scene {
    tree::PreparedTree prepared;
    double cell_mm = 0.0; // one for all methods
    int threads = 2;
};

struct PlainMesh {
    std::vector<glm::vec3> positions;
    std::vector<glm::uvec3> triangles;
};

struct Made {
    std::uint64_t triangles = 0;
    double fill_s = 0.0;              // of the time, what went into filling a grid; 0 where there is none
    std::function<PlainMesh()> plain; // keeps the peer's mesh alive
    std::string refusal;              // why there is no mesh; empty when there is one
};

// Sides of a tube such that their width is the cell size at the length-weighted mean radius; at least 8.
[[nodiscard]] int tube_sides(const Scene& scene);

// A tube per branch, its radius varying along it, its ends capped. Tubes are not joined where branches meet.
[[nodiscard]] Made vtk_tubes(const Scene& scene);
// The isosurface of the same field as ramus', from a dense grid over the box of the tree.
[[nodiscard]] Made vtk_flying_edges(const Scene& scene);
// A union of spheres strung along the segments as a level set; joints are creases.
[[nodiscard]] Made openvdb_spheres(const Scene& scene);
// The isosurface of the same field as ramus', from a sparse grid of the places it reaches.
[[nodiscard]] Made openvdb_field(const Scene& scene);

} // namespace ramus::peers
