#include "core/mesh/loops/spanning_triangles.h"

#include <cstdint>
#include <glm/geometric.hpp>
#include <limits>
#include <utility>

namespace ramus::mesh {

std::vector<glm::uvec3> spanning_triangles(std::span<const glm::dvec3> line) {
    const std::size_t count = line.size();
    if (count < 3) return {};
    // For the part of the line from one corner to a later one, closed by a straight edge: the least area, and the third
    // corner of the triangle at that edge.
    std::vector<double> area(count * count, 0.0);
    std::vector<std::uint32_t> corner(count * count, 0);
    for (std::size_t span = 2; span < count; ++span)
        for (std::size_t from = 0; from + span < count; ++from) {
            const std::size_t to = from + span;
            double& least = area[from * count + to];
            least = std::numeric_limits<double>::max();
            for (std::size_t n = from + 1; n < to; ++n) {
                const double all = area[from * count + n] + area[n * count + to] +
                                   glm::length(glm::cross(line[n] - line[from], line[to] - line[from]));
                if (!(all < least)) continue;
                least = all;
                corner[from * count + to] = static_cast<std::uint32_t>(n);
            }
        }
    std::vector<glm::uvec3> triangles;
    std::vector<std::pair<std::size_t, std::size_t>> left{{0, count - 1}};
    while (!left.empty()) {
        const auto [from, to] = left.back();
        left.pop_back();
        if (to < from + 2) continue;
        const std::size_t n = corner[from * count + to];
        triangles.emplace_back(from, n, to);
        left.emplace_back(from, n), left.emplace_back(n, to);
    }
    return triangles;
}

} // namespace ramus::mesh
