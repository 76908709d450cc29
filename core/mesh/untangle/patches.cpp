#include "core/mesh/untangle/patches.h"

#include "core/base/numbered_set.h"

#include <algorithm>
#include <glm/geometric.hpp>

namespace ramus::mesh {

namespace {

constexpr float kReach = 4.0F; // sides, that a patch reaches beyond what meets

TriangleBox box_around(const TriangleMesh& mesh, const TrianglePair& pair) {
    TriangleBox box;
    float longest = 0.0F;
    for (const std::uint32_t n : {pair.first, pair.second}) {
        const glm::uvec3& t = mesh.triangles[n];
        box.hold(box_of(mesh.positions, t));
        for (int corner = 0; corner < 3; ++corner)
            longest = std::max(longest, glm::distance(mesh.positions[t[corner]], mesh.positions[t[(corner + 1) % 3]]));
    }
    return {box.least - kReach * longest, box.most + kReach * longest};
}

// Some of them where they are more than `most`.
NumberedSet triangles_around(const TriangleMesh& mesh, const TriangleBoxes& boxes, std::span<const TrianglePair> pairs,
                             std::size_t most, Job& job) {
    NumberedSet around(mesh.triangles.size());
    std::size_t count = 0;
    std::vector<TriangleBox> looked_at; // places of pairs have the same triangles around them
    for (const TrianglePair& pair : pairs) {
        if (count > most || job.cancelled()) break;
        const TriangleBox box = box_around(mesh, pair);
        if (std::ranges::any_of(looked_at, [&](const TriangleBox& other) { return holds(other, box); })) continue;
        looked_at.push_back(box);
        boxes.for_each_in(box, [&](std::uint32_t n) { count += around.add(n) ? 1 : 0; });
    }
    return around;
}

// Neighbours, ascending; and, since each edge of a closed surface has two triangles, what is at the end of the patches.
void connect(Patches& patches) {
    // Of an edge both ends have the other one twice: for each of its triangles.
    Grouped<std::uint32_t> ends(patches.vertices.size(), [&](const auto& put) {
        for (const glm::uvec3& t : patches.triangles)
            for (int corner = 0; corner < 3; ++corner) {
                const std::uint32_t a = t[corner], b = t[(corner + 1) % 3];
                put(a, b), put(b, a);
            }
    });
    patches.has_all.assign(patches.vertices.size(), 1);
    for (std::size_t vertex = 0; vertex < patches.vertices.size(); ++vertex) {
        const std::span<std::uint32_t> its = ends.of(vertex);
        std::ranges::sort(its);
        for (std::size_t n = 0; n < its.size(); n += 2) {
            const bool twice = n + 1 < its.size() && its[n] == its[n + 1] && its[n] != vertex &&
                               (n + 2 == its.size() || its[n + 2] != its[n]);
            if (!twice) patches.has_all[vertex] = 0;
        }
    }
    patches.neighbours = Grouped<std::uint32_t>(patches.vertices.size(), [&](const auto& put) {
        for (std::size_t vertex = 0; vertex < patches.vertices.size(); ++vertex) {
            const std::span<const std::uint32_t> its = ends.of(vertex);
            for (std::size_t n = 0; n < its.size(); ++n)
                if (n == 0 || its[n] != its[n - 1]) put(vertex, its[n]);
        }
    });
}

} // namespace

std::optional<Patches> patches_around(const TriangleMesh& mesh, const TriangleBoxes& boxes,
                                      std::span<const TrianglePair> pairs, std::size_t most, Job& job) {
    NumberedSet triangles = triangles_around(mesh, boxes, pairs, most, job);
    const std::vector<std::uint32_t> around = triangles.list();
    if (around.size() > most || job.cancelled()) return std::nullopt;
    NumberedSet vertices(mesh.positions.size());
    for (const std::uint32_t n : around)
        for (int corner = 0; corner < 3; ++corner) vertices.add(mesh.triangles[n][corner]);
    Patches patches;
    patches.vertices = vertices.list();
    for (const std::uint32_t vertex : patches.vertices) patches.positions.push_back(mesh.positions[vertex]);
    for (const std::uint32_t n : around) {
        const glm::uvec3& t = mesh.triangles[n];
        patches.triangles.emplace_back(vertices.place(t.x), vertices.place(t.y), vertices.place(t.z));
    }
    for (const TrianglePair& pair : pairs)
        patches.pairs.push_back({triangles.place(pair.first), triangles.place(pair.second)});
    connect(patches);
    return patches;
}

} // namespace ramus::mesh
