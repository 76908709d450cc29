// Compares the topology of a surface with that of its tree: the numbers of pieces and loops. Shows merged vessels and
// broken vessels anywhere on the surface, but not where they are.
#pragma once

#include "core/mesh/connectivity.h"
#include "core/mesh/triangle_mesh.h"
#include "core/tree/vessel_tree.h"

#include <cstdint>
#include <span>

namespace ramus::validate {

struct Shape {
    mesh::Connectivity surface, tree;
    [[nodiscard]] bool as_tree() const { return surface == tree; }
};

// The pieces and loops of a correct surface of a tree, in which each vessel system has a surface of its own
// (core/mesh/systems.h). `hidden`: by branch id, not 0 if hidden; may be empty.
[[nodiscard]] mesh::Connectivity expected_shape(const tree::VesselTree& tree,
                                                std::span<const std::uint8_t> hidden = {});

// `closed`: the closed surface of all branches. Not meaningful for truncated cones, which are many surfaces.
[[nodiscard]] Shape shape_of(const tree::VesselTree& tree, const mesh::TriangleMesh& closed);

} // namespace ramus::validate
