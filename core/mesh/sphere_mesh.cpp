#include "core/mesh/sphere_mesh.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <map>
#include <utility>
#include <vector>

namespace ramus::mesh {

TriangleMesh sphere_mesh(const glm::dvec3& centre, double radius) {
    constexpr int kDivisions = 5;
    std::vector<glm::dvec3> places{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    std::vector<glm::uvec3> triangles{{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
                                      {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
    for (int division = 0; division < kDivisions; ++division) {
        std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles; // by the ends of an edge
        const auto middle = [&](std::uint32_t a, std::uint32_t b) {
            const auto [found, added] =
                middles.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(places.size()));
            if (added) places.push_back(glm::normalize(places[a] + places[b]));
            return found->second;
        };
        std::vector<glm::uvec3> finer;
        for (const glm::uvec3& t : triangles) {
            const glm::uvec3 m(middle(t.x, t.y), middle(t.y, t.z), middle(t.z, t.x));
            finer.insert(finer.end(), {{t.x, m.x, m.z}, {t.y, m.y, m.x}, {t.z, m.z, m.y}, m});
        }
        triangles = std::move(finer);
    }
    TriangleMesh mesh;
    for (const glm::dvec3& place : places) mesh.positions.push_back(glm::vec3(centre + radius * place));
    mesh.triangles.assign(triangles.begin(), triangles.end());
    return mesh;
}

} // namespace ramus::mesh
