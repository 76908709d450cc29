#include "core/mesh/untangle/untangle.h"

#include "core/mesh/untangle/folds.h"
#include "core/mesh/untangle/patches.h"

#include <algorithm>
#include <atomic>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <oneapi/tbb/parallel_for.h>
#include <optional>
#include <utility>

namespace ramus::mesh {

namespace {

constexpr int kRounds = 32;       // some in most surfaces, 20 where vessels are packed
constexpr float kStep = 0.5F;     // of the way to the middle of the neighbours
constexpr float kFarthest = 0.5F; // of the vessel's radius, that a vertex moves
// What has more is no surface with a fold here and there: cells are larger than its vessels.
constexpr std::size_t kMostPairs = 4096;
constexpr std::size_t kMostTriangles = 200'000; // of all patches: they are compared some tens of times
constexpr std::size_t kMostLooks = 400;         // for each triangle compared; 20 where nothing is wrong

// By triangle: those at folds may meet any. At the places others meet that are there and lie beside each other: where
// two that share a corner meet, one of them is at a fold.
std::vector<Compared> suspects(const TriangleMesh& mesh, const Folds& folds, std::span<const TriangleBox> places) {
    std::vector<Compared> suspected(mesh.triangles.size(), Compared::kNot);
    for (const std::uint32_t n : folds.triangles) suspected[n] = Compared::kWithAll;
    tbb::parallel_for(std::size_t{0}, places.size(), [&](std::size_t place) {
        folds.boxes.for_each_group_in(places[place], [&](std::size_t group, const TriangleBox& around) {
            const bool all = holds(places[place], around);
            folds.boxes.for_each_of(group, [&](std::uint32_t n) {
                const std::atomic_ref<Compared> one(suspected[n]);
                if (one.load(std::memory_order_relaxed) != Compared::kNot) return; // no need of its box
                if (all || boxes_meet(folds.boxes.box(n), places[place]))
                    one.store(Compared::kApart, std::memory_order_relaxed);
            });
        });
    });
    return suspected;
}

// The vertices of pairs, ascending.
std::vector<std::uint32_t> vertices_of(const Patches& patches, std::span<const TrianglePair> pairs) {
    std::vector<std::uint32_t> vertices;
    for (const TrianglePair& pair : pairs)
        for (const std::uint32_t n : {pair.first, pair.second})
            for (int corner = 0; corner < 3; ++corner) vertices.push_back(patches.triangles[n][corner]);
    std::ranges::sort(vertices);
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    return vertices;
}

void draw_smooth(Patches& patches, std::span<const std::uint32_t> moving, const TriangleMesh& mesh) {
    const std::vector<glm::vec3> before = patches.positions;
    for (const std::uint32_t vertex : moving) {
        if (patches.has_all[vertex] == 0) continue;
        const std::span<const std::uint32_t> neighbours = patches.neighbours.of(vertex);
        glm::vec3 middle(0.0F);
        for (const std::uint32_t other : neighbours) middle += before[other] / static_cast<float>(neighbours.size());
        const glm::vec3 to = glm::mix(before[vertex], middle, kStep);
        const std::uint32_t in_mesh = patches.vertices[vertex];
        if (glm::distance(to, mesh.positions[in_mesh]) < kFarthest * mesh.radii[in_mesh])
            patches.positions[vertex] = to;
    }
}

// What meets after vertices have moved: nothing else had met before.
MeetingTriangles meeting_at(const Patches& patches, std::span<const std::uint32_t> moved, Job& job) {
    std::vector<std::uint8_t> is_moved(patches.vertices.size(), 0);
    for (const std::uint32_t vertex : moved) is_moved[vertex] = 1;
    std::vector<Compared> compared;
    compared.reserve(patches.triangles.size());
    for (const glm::uvec3& t : patches.triangles)
        compared.push_back((is_moved[t.x] | is_moved[t.y] | is_moved[t.z]) != 0 ? Compared::kWithAll : Compared::kNot);
    MeetingLimits limits;
    limits.looks = kMostLooks;
    return meeting_triangles(TriangleBoxes(patches.positions, patches.triangles), compared, limits, job);
}

} // namespace

Untangled untangle(TriangleMesh& mesh, std::span<const TriangleBox> places, Job& job) {
    const Folds folds = find_folds(mesh);
    const MeetingTriangles found =
        meeting_triangles(folds.boxes, suspects(mesh, folds, places), {kMostPairs, kMostLooks}, job);
    if (!found.looked_at_all) return {0, 0, false};
    if (found.count == 0) return {};
    const Untangled as_it_was{found.count, found.count};
    if (found.count > kMostPairs) return as_it_was;
    std::optional<Patches> around = patches_around(mesh, folds.boxes, found.pairs, kMostTriangles, job);
    if (!around) return as_it_was;
    Patches& patches = *around;
    std::vector<TrianglePair> pairs = patches.pairs;
    std::vector<glm::vec3> best = patches.positions;
    std::size_t least = pairs.size();
    for (int round = 0; round < kRounds && least > 0; ++round) {
        const std::vector<std::uint32_t> moving = vertices_of(patches, pairs);
        draw_smooth(patches, moving, mesh);
        MeetingTriangles now = meeting_at(patches, moving, job);
        if (job.cancelled()) return as_it_was;
        if (!now.looked_at_all) break;
        pairs = std::move(now.pairs);
        if (pairs.size() < least) least = pairs.size(), best = patches.positions;
    }
    for (std::size_t n = 0; n < best.size(); ++n) mesh.positions[patches.vertices[n]] = best[n];
    return {found.count, least};
}

} // namespace ramus::mesh
