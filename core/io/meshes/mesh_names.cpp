#include "core/io/meshes/mesh_names.h"

#include <algorithm>

namespace ramus::io {

bool names_all(const MeshNames& names, std::span<const std::int32_t> vertex_branches) {
    const auto count = static_cast<std::int32_t>(names.branches.size());
    return !vertex_branches.empty() &&
           std::ranges::all_of(vertex_branches, [count](std::int32_t branch) { return branch >= 0 && branch < count; });
}

std::int32_t branch_of(const glm::uvec3& triangle, std::span<const std::int32_t> vertex_branches) {
    const std::int32_t a = vertex_branches[triangle.x], b = vertex_branches[triangle.y],
                       c = vertex_branches[triangle.z];
    return b == c ? b : a;
}

} // namespace ramus::io
