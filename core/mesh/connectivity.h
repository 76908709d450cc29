// Counts the connected pieces and the loops (handles) of a surface and of a tree. A correct closed surface of a tree
// has one handle for each independent cycle of the tree's graph; another handle is a connection that the tree does not
// have.
#pragma once

#include "core/mesh/triangle_mesh.h"
#include "core/tree/vessel_tree.h"

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace ramus::mesh {

struct Connectivity {
    std::int64_t pieces = 0, loops = 0;
    bool operator==(const Connectivity&) const = default;
};

// The number of connected pieces of a mesh, closed or not. Triangles that share a vertex are connected. All functions
// here ignore vertices that no triangle uses, and triangles whose first two vertices are equal.
[[nodiscard]] int component_count(const TriangleMesh& mesh);

// The pieces and loops of a closed mesh, by Euler's formula V - E + F = 2 (pieces - loops).
[[nodiscard]] Connectivity connectivity_of(const TriangleMesh& closed);
// The pieces and loops of a tree without the branches whose entry in `hidden` is not 0; `hidden` may be empty.
[[nodiscard]] Connectivity connectivity_of(const tree::VesselTree& tree, std::span<const std::uint8_t> hidden = {});

} // namespace ramus::mesh
