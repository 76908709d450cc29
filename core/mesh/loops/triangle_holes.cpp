#include "core/mesh/loops/triangle_holes.h"

namespace ramus::mesh {

void open_hole(TriangleMesh& mesh, std::size_t triangle, const glm::uvec3& hole) {
    const glm::uvec3 t = mesh.triangles[triangle];
    for (int n = 0; n < 3; ++n) {
        const int next = (n + 1) % 3;
        const glm::uvec3 outer(t[n], t[next], hole[next]);
        if (n == 0)
            mesh.triangles[triangle] = outer;
        else
            mesh.triangles.push_back(outer);
        mesh.triangles.emplace_back(t[n], hole[next], hole[n]);
    }
}

void connect_holes(TriangleMesh& mesh, const glm::uvec3& hole, const glm::uvec3& across) {
    for (int n = 0; n < 3; ++n) {
        const int next = (n + 1) % 3;
        mesh.triangles.emplace_back(hole[n], hole[next], across[next]);
        mesh.triangles.emplace_back(hole[n], across[next], across[n]);
    }
}

} // namespace ramus::mesh
