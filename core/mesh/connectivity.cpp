#include "core/mesh/connectivity.h"

#include <algorithm>

namespace ramus::mesh {

int component_count(const TriangleMesh& mesh) { return static_cast<int>(connectivity_of(mesh).pieces); }

void ConnectivityCount::add_vertices(std::size_t count) {
    pieces_.add(count);
    used_.resize(used_.size() + count, false);
}

void ConnectivityCount::add_triangles(std::span<const glm::uvec3> more) {
    for (const glm::uvec3& triangle : more) {
        if (triangle[0] == triangle[1]) continue;
        ++triangles_;
        for (int corner = 0; corner < 3; ++corner) used_[triangle[corner]] = true;
        pieces_.join(triangle[0], triangle[1]);
        pieces_.join(triangle[0], triangle[2]);
    }
}

Connectivity ConnectivityCount::connectivity() const {
    const auto unused = std::ranges::count(used_, false);
    const auto pieces = static_cast<std::int64_t>(pieces_.count()) - unused;
    const auto vertices = static_cast<std::int64_t>(used_.size()) - unused;
    // A closed surface has three edges for two triangles, and pieces - loops is half of its Euler characteristic.
    return {pieces, pieces - (vertices - triangles_ / 2) / 2};
}

Connectivity connectivity_of(const TriangleMesh& closed) {
    ConnectivityCount count;
    count.add_vertices(closed.positions.size());
    count.add_triangles(closed.triangles);
    return count.connectivity();
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
