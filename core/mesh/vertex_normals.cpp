#include "core/mesh/vertex_normals.h"

#include <glm/geometric.hpp>
#include <vector>

namespace ramus::mesh {

void add_normals(TriangleMesh& mesh) {
    std::vector<glm::dvec3> sums(mesh.positions.size(), glm::dvec3(0.0));
    for (const glm::uvec3& t : mesh.triangles) {
        const glm::dvec3 a(mesh.positions[t.x]), b(mesh.positions[t.y]), c(mesh.positions[t.z]);
        const glm::dvec3 normal = glm::cross(b - a, c - a); // as long as twice the area
        for (int k = 0; k < 3; ++k) sums[t[k]] += normal;
    }
    mesh.normals.resize(sums.size());
    for (std::size_t v = 0; v < sums.size(); ++v) {
        const double length = glm::length(sums[v]);
        mesh.normals[v] = length > 0.0 ? glm::vec3(sums[v] / length) : glm::vec3(0.0F, 0.0F, 1.0F);
    }
}

} // namespace ramus::mesh
