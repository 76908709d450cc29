#include "core/measure/mesh_components.h"

#include "core/base/disjoint_sets.h"

#include <algorithm>
#include <vector>

namespace ramus::measure {

int component_count(const mesh::TriangleMesh& mesh) {
    DisjointSets pieces(mesh.positions.size());
    std::vector<bool> used(mesh.positions.size(), false);
    for (const glm::uvec3& triangle : mesh.triangles) {
        for (int corner = 0; corner < 3; ++corner) used[triangle[corner]] = true;
        pieces.join(triangle[0], triangle[1]);
        pieces.join(triangle[0], triangle[2]);
    }
    return static_cast<int>(pieces.count()) - static_cast<int>(std::ranges::count(used, false));
}

} // namespace ramus::measure
