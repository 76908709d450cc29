#include "core/measure/mesh_components.h"

#include <numeric>

namespace ramus::measure {

int component_count(const mesh::TriangleMesh& mesh) {
    std::vector<std::uint32_t> stands(mesh.positions.size());
    std::iota(stands.begin(), stands.end(), 0U);
    std::vector<bool> used(mesh.positions.size(), false);
    const auto find = [&](std::uint32_t v) {
        while (stands[v] != v) v = stands[v] = stands[stands[v]];
        return v;
    };
    int joined = 0;
    int vertices = 0;
    for (const glm::uvec3& triangle : mesh.triangles) {
        for (int corner = 0; corner < 3; ++corner) {
            if (!used[triangle[corner]]) ++vertices;
            used[triangle[corner]] = true;
        }
        for (int corner = 1; corner < 3; ++corner) {
            const std::uint32_t a = find(triangle[0]);
            const std::uint32_t b = find(triangle[corner]);
            if (a == b) continue;
            stands[b > a ? b : a] = b > a ? a : b;
            ++joined;
        }
    }
    return vertices - joined;
}

} // namespace ramus::measure
