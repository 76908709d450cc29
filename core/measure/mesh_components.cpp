#include "core/measure/mesh_components.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace ramus::measure {

void ComponentCounter::add_vertices(std::size_t count) {
    const std::size_t first = stands_.size();
    stands_.resize(first + count);
    for (std::size_t v = first; v < stands_.size(); ++v) stands_[v] = static_cast<std::uint32_t>(v);
}

std::uint32_t ComponentCounter::find(std::uint32_t vertex) {
    while (stands_[vertex] != vertex) vertex = stands_[vertex] = stands_[stands_[vertex]];
    return vertex;
}

void ComponentCounter::join(std::uint32_t a, std::uint32_t b) {
    a = find(a);
    b = find(b);
    if (a == b) return;
    stands_[std::max(a, b)] = std::min(a, b);
    ++joined_;
}

int component_count(const mesh::TriangleMesh& mesh) {
    ComponentCounter counter;
    counter.add_vertices(mesh.positions.size());
    std::vector<bool> used(mesh.positions.size(), false);
    for (const glm::uvec3& triangle : mesh.triangles) {
        for (int corner = 0; corner < 3; ++corner) used[triangle[corner]] = true;
        counter.join(triangle[0], triangle[1]);
        counter.join(triangle[0], triangle[2]);
    }
    return counter.count() - static_cast<int>(std::ranges::count(used, false));
}

} // namespace ramus::measure
