#include "core/mesh/untangle/folds.h"

#include "core/base/lists_by_thread.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>
#include <span>
#include <utility>

namespace ramus::mesh {

namespace {

bool faces_away(const TriangleMesh& mesh, const glm::uvec3& t) {
    const glm::vec3 a = mesh.positions[t.x], b = mesh.positions[t.y], c = mesh.positions[t.z];
    const glm::vec3 area = glm::cross(b - a, c - a);
    bool away = false; // no test depends on another
    for (int corner = 0; corner < 3; ++corner) away |= glm::dot(area, mesh.normals[t[corner]]) <= 0.0F;
    return away;
}

std::vector<std::uint32_t> at_corners_of(const TriangleMesh& mesh, std::span<const std::uint32_t> triangles) {
    LargeArray<std::uint8_t> marked(mesh.positions.size(), 0, mesh.memory()); // no bits: several threads read them
    for (const std::uint32_t n : triangles)
        for (int corner = 0; corner < 3; ++corner) marked[mesh.triangles[n][corner]] = 1;
    ListsByThread<std::uint32_t> found;
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, mesh.triangles.size()), [&](const auto& range) {
        std::vector<std::uint32_t>& mine = found.local();
        for (std::size_t n = range.begin(); n < range.end(); ++n) {
            const glm::uvec3& t = mesh.triangles[n];
            if ((marked[t.x] | marked[t.y] | marked[t.z]) != 0) mine.push_back(static_cast<std::uint32_t>(n));
        }
    });
    return found.sorted();
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
    std::vector<std::uint32_t> triangles = folded.sorted();
    if (!triangles.empty()) triangles = at_corners_of(mesh, triangles);
    return {std::move(triangles), TriangleBoxes(mesh.positions, mesh.triangles, std::move(groups))};
}

} // namespace ramus::mesh
