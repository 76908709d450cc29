// MeshNames: names and colours of the parts of a surface, for mesh formats that can hold them: GLB (a node for each
// system or branch) and VTP (arrays and names of systems).
#pragma once

#include "core/io/orientation.h"
#include "core/tree/vessel_tree.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <vector>

namespace ramus::io {

// The parts that become separate objects in formats that have several. A mesh without such parts is one object.
enum class PartsBy : std::uint8_t { kNone, kSystem, kBranch };

using Colour = std::array<std::uint8_t, 3>; // sRGB

struct MeshNames {
    struct Branch {
        std::string name;
        Colour colour{};
        int system = 0; // index into `systems`, if there are any
    };
    // What a format may say of a branch, as `ramus info` has it.
    struct Vessel {
        int parent = tree::kNoBranch, generation = 0, strahler = 0;
        double length_mm = 0.0, radius_mm = 0.0; // the mean radius
    };
    std::string name = "surface"; // of the whole mesh
    Colour colour{204, 73, 60};   // of parts without their own colour
    PartsBy by = PartsBy::kNone;
    bool compressed = false;           // of formats that can be
    std::size_t pieces = 0;            // of formats in several files; 0: as many as are of a usual size
    std::vector<tree::System> systems; // of the tree; empty: none
    std::vector<Branch> branches;      // by branch id; empty: unknown
    std::vector<Vessel> vessels;       // by branch id; empty: the parts are no vessels
    tree::Claims claims;               // of the tree whose surface it is
    Orientation axes;                  // of the file; RAS unless the claims state the tree's axes
};

// Whether `vertex_branches` is not empty and `names` has every branch in it.
[[nodiscard]] bool names_all(const MeshNames& names, std::span<const std::int32_t> vertex_branches);

// The branch of a triangle: the branch of at least two corners, or of the first corner if all three differ.
[[nodiscard]] std::int32_t branch_of(const glm::uvec3& triangle, std::span<const std::int32_t> vertex_branches);

} // namespace ramus::io
