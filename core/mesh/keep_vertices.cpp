#include "core/mesh/keep_vertices.h"

namespace ramus::mesh {

void keep_vertices(TriangleMesh& mesh, const LargeArray<std::uint32_t>& number, std::size_t count) {
    mesh.for_each_array([&](auto& array) {
        if (array.empty()) return;
        for (std::size_t v = 0; v < number.size(); ++v)
            if (number[v] != kNotKept) array[number[v]] = array[v];
        array.resize(count);
    });
    std::size_t kept = 0;
    for (const glm::uvec3& t : mesh.triangles)
        if (number[t.x] != kNotKept) mesh.triangles[kept++] = {number[t.x], number[t.y], number[t.z]};
    mesh.triangles.resize(kept);
}

void keep_used_vertices(TriangleMesh& mesh) {
    LargeArray<std::uint32_t> number(mesh.positions.size(), kNotKept, mesh.memory());
    for (const glm::uvec3& t : mesh.triangles)
        for (int corner = 0; corner < 3; ++corner) number[t[corner]] = 0;
    std::uint32_t kept = 0;
    for (std::uint32_t& one : number)
        if (one != kNotKept) one = kept++;
    keep_vertices(mesh, number, kept);
}

} // namespace ramus::mesh
