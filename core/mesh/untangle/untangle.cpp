#include "core/mesh/untangle/untangle.h"

#include "core/base/lists_by_thread.h"
#include "core/mesh/untangle/exact_triangles.h"
#include "core/mesh/untangle/folds.h"
#include "core/mesh/untangle/patches.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <oneapi/tbb/parallel_for.h>

namespace ramus::mesh {

namespace {

constexpr int kRounds = 32;       // some in most surfaces, 20 where vessels are packed
constexpr float kStep = 0.5F;     // of the way to the middle of the neighbours
constexpr float kFarthest = 0.5F; // of the vessel's radius, that a vertex moves
// What has more is no surface with a fold here and there: cells are larger than its vessels.
constexpr std::size_t kMostPairs = 4096;
constexpr std::size_t kMostTriangles = 200'000; // of all patches: they are compared some tens of times
constexpr std::size_t kMostLooks = 400;         // for each triangle suspected; 20 where nothing is wrong

struct Meeting {
    std::vector<TrianglePair> pairs; // ascending
    bool all = true;                 // false: there are far too many, and these are some
};

// By triangle: whether it is at a fold, or at one of the places.
std::vector<std::uint8_t> suspects(const TriangleMesh& mesh, const Folds& folds, std::span<const TriangleBox> places) {
    std::vector<std::uint8_t> suspected(mesh.triangles.size(), 0);
    for (const std::uint32_t n : folds.triangles) suspected[n] = 1;
    for (const TriangleBox& place : places) folds.boxes.for_each_in(place, [&](std::uint32_t n) { suspected[n] = 1; });
    return suspected;
}

// Pairs of a surface's triangles of which at least one is suspected. Those of a group are looked at together.
Meeting meeting_among(const TriangleMesh& mesh, const TriangleBoxes& boxes, std::span<const std::uint8_t> suspected) {
    ListsByThread<TrianglePair> found;
    std::atomic<std::size_t> looks{0};
    const auto count = static_cast<std::size_t>(std::ranges::count(suspected, 1));
    constexpr std::size_t kGroup = TriangleBoxes::kGroup;
    tbb::parallel_for(std::size_t{0}, (suspected.size() + kGroup - 1) / kGroup, [&](std::size_t group) {
        const std::size_t begin = kGroup * group, end = std::min(begin + kGroup, suspected.size());
        if (std::ranges::count(suspected.subspan(begin, end - begin), 1) == 0) return;
        if (looks.load(std::memory_order_relaxed) > kMostLooks * count) return;
        EightBoxes asked; // around nothing of what is not suspected
        for (std::size_t n = begin; n < end; ++n)
            if (suspected[n] != 0) asked.set(n - begin, box_of(mesh, mesh.triangles[n]));
        std::size_t its = 0;
        boxes.for_each_in(asked.around(), [&](std::uint32_t other) {
            for (unsigned bits = asked.meeting(box_of(mesh, mesh.triangles[other])); bits != 0; bits &= bits - 1) {
                const auto n = static_cast<std::uint32_t>(begin) + static_cast<std::uint32_t>(std::countr_zero(bits));
                if (n == other || (suspected[other] != 0 && other < n)) continue; // which it finds itself
                ++its;
                if (triangles_meet(mesh.positions, mesh.triangles[n], mesh.triangles[other]))
                    found.local().push_back({std::min(n, other), std::max(n, other)});
            }
        });
        looks += its;
    });
    Meeting meeting{found.sorted()};
    meeting.all = looks <= kMostLooks * count && meeting.pairs.size() <= kMostPairs;
    return meeting;
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
std::vector<TrianglePair> meeting_at(const Patches& patches, std::span<const std::uint32_t> moved) {
    std::vector<std::uint8_t> is_moved(patches.vertices.size(), 0), asked;
    for (const std::uint32_t vertex : moved) is_moved[vertex] = 1;
    asked.reserve(patches.triangles.size());
    for (const glm::uvec3& t : patches.triangles) asked.push_back(is_moved[t.x] | is_moved[t.y] | is_moved[t.z]);
    return meeting_triangles(patches.positions, patches.triangles, asked);
}

} // namespace

Untangled untangle(TriangleMesh& mesh, std::span<const TriangleBox> places, Job& job) {
    const Folds folds = find_folds(mesh);
    const auto [found, all_found] = meeting_among(mesh, folds.boxes, suspects(mesh, folds, places));
    if (found.empty()) return {};
    if (!all_found) return {found.size(), found.size()};
    Patches patches = patches_around(mesh, folds.boxes, found);
    if (patches.triangles.size() > kMostTriangles) return {found.size(), found.size()};
    std::vector<TrianglePair> pairs = patches.pairs;
    std::vector<glm::vec3> best = patches.positions;
    std::size_t least = pairs.size();
    for (int round = 0; round < kRounds && least > 0; ++round) {
        if (job.cancelled()) return {found.size(), found.size()};
        const std::vector<std::uint32_t> moving = vertices_of(patches, pairs);
        draw_smooth(patches, moving, mesh);
        pairs = meeting_at(patches, moving);
        if (pairs.size() < least) least = pairs.size(), best = patches.positions;
    }
    for (std::size_t n = 0; n < best.size(); ++n) mesh.positions[patches.vertices[n]] = best[n];
    return {found.size(), least};
}

} // namespace ramus::mesh
