#include "core/mesh/loops/match_tree.h"

#include "core/mesh/connectivity.h"
#include "core/mesh/loops/drop_false_pieces.h"

#include <optional>

namespace ramus::mesh {

bool matches_tree(const TriangleMesh& mesh, const tree::VesselTree& tree) {
    return connectivity_of(mesh) == connectivity_of(tree);
}

MatchedTree match_tree(TriangleMesh& mesh, const tree::PreparedTree& tree, std::span<const Bounds<glm::vec3>> walls,
                       double memory_bytes, Job& job, const std::shared_ptr<ArrayMemory>& disk) {
    MatchedTree matched;
    std::optional<SurfaceParts> parts;
    const auto divide = [&] {
        const TriangleBoxes boxes(
            mesh.positions, walls.empty() ? std::span<const glm::uvec3>{} : std::span<const glm::uvec3>(mesh.triangles),
            mesh.memory());
        parts.emplace(mesh, boxes, triangles_at(mesh, boxes, walls));
    };
    divide();
    if (parts->of_surface().pieces > 1) matched.dropped = drop_false_pieces(mesh, tree.tree);
    if (matched.dropped > 0) divide();
    const std::int64_t lost = connectivity_of(tree.tree).loops - parts->of_surface().loops;
    if (lost < 0)
        matched.false_loops = cut_false_loops(mesh, tree, *parts, memory_bytes, job);
    else if (lost > 0)
        matched.lost_loops = open_lost_loops(mesh, tree.tree, static_cast<std::size_t>(lost), memory_bytes, job, disk);
    return matched;
}

} // namespace ramus::mesh
