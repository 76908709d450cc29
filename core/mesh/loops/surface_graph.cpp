#include "core/mesh/loops/surface_graph.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <oneapi/tbb/parallel_sort.h>

namespace ramus::mesh {

SurfaceGraph::SurfaceGraph(const TriangleMesh& mesh) : mesh_(&mesh) {
    struct Side {
        std::uint64_t ends; // the lower one first
        std::uint32_t triangle;
        bool operator<(const Side& other) const {
            return ends != other.ends ? ends < other.ends : triangle < other.triangle;
        }
    };
    std::vector<Side> sides;
    sides.reserve(3 * mesh.triangles.size());
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
        for (int corner = 0; corner < 3; ++corner) {
            const auto [low, high] = std::minmax(mesh.triangles[t][corner], mesh.triangles[t][(corner + 1) % 3]);
            sides.push_back({std::uint64_t{low} << 32 | high, static_cast<std::uint32_t>(t)});
        }
    tbb::parallel_sort(sides.begin(), sides.end());
    const auto is_pair = [&](std::size_t n) {
        return n + 1 < sides.size() && sides[n].ends == sides[n + 1].ends &&
               (n + 2 >= sides.size() || sides[n].ends != sides[n + 2].ends);
    };
    for (std::size_t n = 0; n < sides.size() && closed_; n += 2) closed_ = is_pair(n);
    if (!closed_) sides.clear();
    edges_.reserve(sides.size() / 2);
    for (std::size_t n = 0; n + 1 < sides.size(); n += 2)
        edges_.push_back({{static_cast<std::uint32_t>(sides[n].ends >> 32), static_cast<std::uint32_t>(sides[n].ends)},
                          {sides[n].triangle, sides[n + 1].triangle}});
    at_ = Grouped<std::uint32_t>(mesh.positions.size(), [&](const auto& put) {
        for (std::uint32_t e = 0; e < edges_.size(); ++e)
            for (const std::uint32_t end : edges_[e].ends) put(end, e);
    });
}

double SurfaceGraph::length(std::uint32_t edge) const {
    const auto& [a, b] = edges_[edge].ends;
    return glm::distance(glm::dvec3(mesh_->positions[a]), glm::dvec3(mesh_->positions[b]));
}

} // namespace ramus::mesh
