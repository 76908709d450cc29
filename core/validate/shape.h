// How a surface hangs together, held against its tree: pieces and loops. What two vessels that touch have grown
// together by, and what a vessel has come apart by, shows here wherever it is.
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

// What the surface of a tree has where each vessel system has a surface of its own (core/mesh/systems.h). `hidden`: by
// branch id, not 0: left out; may be empty.
[[nodiscard]] mesh::Connectivity expected_shape(const tree::VesselTree& tree,
                                                std::span<const std::uint8_t> hidden = {});

// `closed`: the surface of all branches, without a hole. Cones are many surfaces, and say nothing here.
[[nodiscard]] Shape shape_of(const tree::VesselTree& tree, const mesh::TriangleMesh& closed);

} // namespace ramus::validate
