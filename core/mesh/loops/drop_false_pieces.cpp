#include "core/mesh/loops/drop_false_pieces.h"

#include "core/base/bounds.h"
#include "core/base/disjoint_sets.h"
#include "core/mesh/keep_vertices.h"
#include "core/mesh/loops/axes.h"

#include <glm/geometric.hpp>
#include <unordered_map>

namespace ramus::mesh {

namespace {

struct MeshPart {
    Bounds<glm::dvec3> box;
    double volume = 0.0; // mm^3, six times; negative: a cavity
};

} // namespace

std::size_t drop_false_pieces(TriangleMesh& mesh, const tree::VesselTree& tree) {
    DisjointSets sets(mesh.positions.size(), mesh.memory());
    for (const glm::uvec3& t : mesh.triangles) sets.join(t.x, t.y), sets.join(t.x, t.z);
    if (sets.count() < 2) return 0;
    std::unordered_map<std::uint32_t, MeshPart> parts; // by the lowest vertex
    for (const glm::uvec3& t : mesh.triangles) {
        const auto first = sets.find(t.x);
        MeshPart& part = parts[first];
        const glm::dvec3 origin(mesh.positions[first]);
        const auto corner = [&](int n) { return glm::dvec3(mesh.positions[t[n]]) - origin; };
        part.volume += glm::dot(corner(0), glm::cross(corner(1), corner(2)));
        for (int n = 0; n < 3; ++n) part.box.hold(corner(n) + origin);
    }
    const Axes axes(tree);
    LargeArray<std::uint32_t> number(mesh.positions.size(), kNotKept, mesh.memory());
    std::uint32_t kept = 0;
    std::size_t dropped = std::erase_if(
        parts, [&](const auto& part) { return part.second.volume < 0.0 || !axes.reach(part.second.box); });
    if (dropped == 0) return 0;
    for (std::uint32_t v = 0; v < number.size(); ++v)
        if (parts.contains(sets.find(v))) number[v] = kept++;
    keep_vertices(mesh, number, kept);
    return dropped;
}

} // namespace ramus::mesh
