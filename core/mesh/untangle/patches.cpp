#include "core/mesh/untangle/patches.h"

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <utility>

namespace ramus::mesh {

namespace {

using Edge = std::array<std::uint32_t, 2>; // the lower end first

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

// Ascending; some of them where they are more than `most`.
std::vector<std::uint32_t> triangles_around(const TriangleMesh& mesh, const TriangleBoxes& boxes,
                                            std::span<const TrianglePair> pairs, std::size_t most, Job& job) {
    std::vector<std::uint8_t> taken(mesh.triangles.size(), 0); // places of pairs have the same triangles around them
    std::vector<std::uint32_t> around;
    std::vector<TriangleBox> looked_at;
    for (const TrianglePair& pair : pairs) {
        if (around.size() > most || job.cancelled()) break;
        const TriangleBox box = box_around(mesh, pair);
        if (std::ranges::any_of(looked_at, [&](const TriangleBox& other) { return holds(other, box); })) continue;
        looked_at.push_back(box);
        boxes.for_each_in(box, [&](std::uint32_t n) {
            if (std::exchange(taken[n], std::uint8_t{1}) == 0) around.push_back(n);
        });
    }
    std::ranges::sort(around);
    return around;
}

// Neighbours; and, since each edge of a closed surface has two triangles, what is at the end of the patches.
void connect(Patches& patches) {
    std::vector<Edge> edges;
    edges.reserve(3 * patches.triangles.size());
    for (const glm::uvec3& t : patches.triangles)
        for (int corner = 0; corner < 3; ++corner) {
            const auto [low, high] = std::minmax(t[corner], t[(corner + 1) % 3]);
            edges.push_back({low, high});
        }
    std::ranges::sort(edges);
    patches.has_all.assign(patches.vertices.size(), 1);
    for (std::size_t first = 0, next = 0; first < edges.size(); first = next) {
        while (next < edges.size() && edges[next] == edges[first]) ++next;
        if (next - first != 2)
            for (const std::uint32_t end : edges[first]) patches.has_all[end] = 0;
    }
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    patches.neighbours = Grouped<std::uint32_t>(patches.vertices.size(), [&](const auto& put) {
        for (const Edge& edge : edges) put(edge[0], edge[1]), put(edge[1], edge[0]);
    });
}

} // namespace

std::optional<Patches> patches_around(const TriangleMesh& mesh, const TriangleBoxes& boxes,
                                      std::span<const TrianglePair> pairs, std::size_t most, Job& job) {
    const std::vector<std::uint32_t> around = triangles_around(mesh, boxes, pairs, most, job);
    if (around.size() > most || job.cancelled()) return std::nullopt;
    Patches patches;
    for (const std::uint32_t n : around)
        for (int corner = 0; corner < 3; ++corner) patches.vertices.push_back(mesh.triangles[n][corner]);
    std::ranges::sort(patches.vertices);
    patches.vertices.erase(std::unique(patches.vertices.begin(), patches.vertices.end()), patches.vertices.end());
    for (const std::uint32_t vertex : patches.vertices) patches.positions.push_back(mesh.positions[vertex]);
    const auto place_in = [](const std::vector<std::uint32_t>& sorted, std::uint32_t of) {
        return static_cast<std::uint32_t>(std::ranges::lower_bound(sorted, of) - sorted.begin());
    };
    for (const std::uint32_t n : around) {
        const glm::uvec3& t = mesh.triangles[n];
        patches.triangles.emplace_back(place_in(patches.vertices, t.x), place_in(patches.vertices, t.y),
                                       place_in(patches.vertices, t.z));
    }
    for (const TrianglePair& pair : pairs)
        patches.pairs.push_back({place_in(around, pair.first), place_in(around, pair.second)});
    connect(patches);
    return patches;
}

} // namespace ramus::mesh
