#include "core/mesh/untangle/folds.h"

#include "core/base/lists_by_thread.h"
#include "core/base/numbers_where.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <span>
#include <utility>
#include <vector>

namespace ramus::mesh {

namespace {

bool faces_away(const TriangleMesh& mesh, const glm::uvec3& t) {
    const glm::vec3 a = mesh.positions[t.x], b = mesh.positions[t.y], c = mesh.positions[t.z];
    const glm::vec3 area = glm::cross(b - a, c - a);
    bool away = false; // no test depends on another
    for (int corner = 0; corner < 3; ++corner) away |= glm::dot(area, mesh.normals[t[corner]]) <= 0.0F;
    return away;
}

LargeArray<std::uint32_t> at_corners_of(const TriangleMesh& mesh, std::span<const std::uint32_t> triangles) {
    LargeArray<std::uint8_t> marked(mesh.positions.size(), 0, mesh.memory()); // no bits: several threads read them
    for (const std::uint32_t n : triangles)
        for (int corner = 0; corner < 3; ++corner) marked[mesh.triangles[n][corner]] = 1;
    const auto is_at = [&](std::uint32_t n) {
        const glm::uvec3& t = mesh.triangles[n];
        return (marked[t.x] | marked[t.y] | marked[t.z]) != 0;
    };
    return numbers_where(mesh.triangles.size(), is_at, mesh.memory());
}

} // namespace

Folds find_folds(const TriangleMesh& mesh) {
    ListsByThread<std::uint32_t> folded;
    auto groups = TriangleBoxes::groups_of(
        mesh.positions, mesh.triangles,
        [&](std::size_t n) {
            if (faces_away(mesh, mesh.triangles[n])) folded.local().push_back(static_cast<std::uint32_t>(n));
        },
        mesh.memory());
    const std::vector<std::uint32_t> triangles = folded.sorted();
    return {triangles.empty() ? LargeArray<std::uint32_t>() : at_corners_of(mesh, triangles),
            TriangleBoxes(mesh.positions, mesh.triangles, std::move(groups))};
}

} // namespace ramus::mesh
