// How a surface hangs together, beside the tree that it is made of: pieces, and loops. A vessel's closed surface has a
// handle for each independent cycle of its graph; one more is a connection that the tree has not.
#pragma once

#include "core/mesh/triangle_mesh.h"
#include "core/tree/vessel_tree.h"

#include <cstdint>
#include <span>

namespace ramus::measure {

struct Connectivity {
    std::int64_t pieces = 0, loops = 0;
    bool operator==(const Connectivity&) const = default;
};

// How many connected pieces a mesh has, closed or not: triangles that share a vertex belong together. Vertices that no
// triangle uses do not count, here and below.
[[nodiscard]] int component_count(const mesh::TriangleMesh& mesh);

// Of a closed surface, from its counts (Euler's formula).
[[nodiscard]] Connectivity connectivity_of(std::int64_t pieces, std::int64_t vertices, std::int64_t triangles);
[[nodiscard]] Connectivity connectivity_of(const mesh::TriangleMesh& closed);
// Of what is left of a tree without the branches whose entry in `hidden` is not 0; it may be empty.
[[nodiscard]] Connectivity connectivity_of(const tree::VesselTree& tree, std::span<const std::uint8_t> hidden = {});

} // namespace ramus::measure
