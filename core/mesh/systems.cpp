#include "core/mesh/systems.h"

#include <algorithm>
#include <utility>

namespace ramus::mesh {

std::vector<std::uint8_t> hidden_beside(const tree::VesselTree& tree, int system,
                                        std::span<const std::uint8_t> hidden) {
    std::vector<std::uint8_t> flags(tree.branches.size(), 0);
    for (std::size_t id = 0; id < flags.size(); ++id)
        flags[id] = tree.branches[id].system != system || (id < hidden.size() && hidden[id] != 0) ? 1 : 0;
    return flags;
}

std::vector<std::vector<std::uint8_t>> hidden_by_system(const tree::VesselTree& tree,
                                                        std::span<const std::uint8_t> hidden) {
    std::vector<std::vector<std::uint8_t>> parts;
    for (int system = 0; system < static_cast<int>(tree.systems.size()); ++system) {
        std::vector<std::uint8_t> flags = hidden_beside(tree, system, hidden);
        if (std::ranges::find(flags, 0) != flags.end()) parts.push_back(std::move(flags));
    }
    if (parts.size() < 2) parts.assign(1, {hidden.begin(), hidden.end()});
    return parts;
}

void append(TriangleMesh& mesh, TriangleMesh more) {
    if (mesh.positions.empty() && mesh.triangles.empty()) {
        mesh = std::move(more);
        return;
    }
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    const auto add = [](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); };
    add(mesh.positions, more.positions);
    add(mesh.normals, more.normals);
    add(mesh.radii, more.radii);
    add(mesh.branches, more.branches);
    add(mesh.dominance, more.dominance);
    mesh.triangles.reserve(mesh.triangles.size() + more.triangles.size());
    for (const glm::uvec3& triangle : more.triangles) mesh.triangles.push_back(triangle + first);
}

} // namespace ramus::mesh
