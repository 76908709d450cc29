// What the branches of a surface are called and look like, for mesh formats that can say so: GLB has a node for each
// system or branch, VTP arrays and the names of systems. A mesh file without it has triangles and nothing to call them.
#pragma once

#include "core/io/orientation.h"
#include "core/tree/vessel_tree.h"

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <vector>

namespace ramus::io {

// What is an object of its own in formats that have several. What a mesh has none of is not divided by it.
enum class PartsBy : std::uint8_t { kNone, kSystem, kBranch };

using Colour = std::array<std::uint8_t, 3>; // sRGB

struct MeshNames {
    struct Branch {
        std::string name;
        Colour colour{};
        int system = 0; // index into `systems`, where there are any
    };
    std::string name = "surface"; // of the whole
    Colour colour{204, 73, 60};   // of what has none of its own
    PartsBy by = PartsBy::kNone;
    std::vector<tree::System> systems; // of the tree; empty: none
    std::vector<Branch> branches;      // by branch id; empty: not known
    tree::Claims claims;               // of the tree that the surface is of
    Orientation axes;                  // of the file; others than RAS only where the claims have sides
};

// Whether it names every branch that is in `vertex_branches`, and that has any.
[[nodiscard]] bool names_all(const MeshNames& names, std::span<const std::int32_t> vertex_branches);

// The branch of a triangle: that of two corners at least; of three different ones the first corner's.
[[nodiscard]] std::int32_t branch_of(const glm::uvec3& triangle, std::span<const std::int32_t> vertex_branches);

} // namespace ramus::io
