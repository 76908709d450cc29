#include "core/mesh/connectivity.h"

#include "core/base/disjoint_sets.h"

#include <algorithm>

namespace ramus::mesh {

int component_count(const TriangleMesh& mesh) { return static_cast<int>(connectivity_of(mesh).pieces); }

Connectivity connectivity_of(const TriangleMesh& closed) {
    DisjointSets sets(closed.positions.size(), closed.memory());
    std::vector<bool> used(closed.positions.size(), false);
    std::int64_t triangles = 0;
    for (const glm::uvec3& triangle : closed.triangles) {
        if (triangle[0] == triangle[1]) continue;
        ++triangles;
        for (int corner = 0; corner < 3; ++corner) used[triangle[corner]] = true;
        sets.join(triangle[0], triangle[1]);
        sets.join(triangle[0], triangle[2]);
    }
    const auto unused = std::ranges::count(used, false);
    const auto pieces = static_cast<std::int64_t>(sets.count()) - unused;
    const auto vertices = static_cast<std::int64_t>(used.size()) - unused;
    // A closed surface has three edges for two triangles, and pieces - loops is half of its Euler characteristic.
    return {pieces, pieces - (vertices - triangles / 2) / 2};
}

Connectivity connectivity_of(const tree::VesselTree& tree, std::span<const std::uint8_t> hidden) {
    DisjointSets sets(tree.points.size());
    std::vector<bool> used(tree.points.size(), false);
    std::int64_t segments = 0;
    for (std::size_t b = 0; b < tree.branches.size(); ++b) {
        if (b < hidden.size() && hidden[b] != 0) continue;
        const auto& points = tree.branches[b].points;
        for (std::size_t n = 0; n < points.size(); ++n) {
            used[points[n]] = true;
            if (n == 0) continue;
            sets.join(points[n - 1], points[n]);
            ++segments;
        }
    }
    const auto unused = std::ranges::count(used, false);
    const auto pieces = static_cast<std::int64_t>(sets.count()) - unused;
    return {pieces, segments - (static_cast<std::int64_t>(tree.points.size()) - unused) + pieces};
}

} // namespace ramus::mesh
