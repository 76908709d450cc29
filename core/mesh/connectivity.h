// How a surface hangs together, beside the tree that it is made of: pieces, and loops. A vessel's closed surface has a
// handle for each independent cycle of its graph; one more is a connection that the tree has not.
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

// How many connected pieces a mesh has, closed or not: triangles that share a vertex belong together. Vertices that no
// triangle uses do not count, nor do triangles whose first two are one, here and below.
[[nodiscard]] int component_count(const TriangleMesh& mesh);

// By Euler's formula.
[[nodiscard]] Connectivity connectivity_of(const TriangleMesh& closed);
// Of what is left of a tree without the branches whose entry in `hidden` is not 0; it may be empty.
[[nodiscard]] Connectivity connectivity_of(const tree::VesselTree& tree, std::span<const std::uint8_t> hidden = {});

} // namespace ramus::mesh
