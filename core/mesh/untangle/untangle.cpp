#include "core/mesh/untangle/untangle.h"

#include "core/base/sort_unique.h"
#include "core/mesh/untangle/folds.h"
#include "core/mesh/untangle/patches.h"

#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <oneapi/tbb/parallel_for.h>
#include <utility>

namespace ramus::mesh {

namespace {

constexpr int kRounds = 64;       // most places need a few, packed vessels 40
constexpr int kInTurn = 4;        // so many rounds push inward, then as many smooth
constexpr float kStep = 0.5F;     // share of the way to the mean of the neighbours in a smoothing step
constexpr float kFarthest = 0.5F; // the largest move of a vertex, in radii
// Limits of a place. With more pairs it is no fold: cells are larger than the vessels there.
constexpr std::size_t kMostPairs = 4096;
constexpr std::size_t kMostTriangles = 200'000; // a place is tested some tens of times
constexpr std::size_t kMostListed = 4'000'000;  // pairs of a surface
constexpr std::size_t kMostLooks = 400;         // comparisons for each triangle; 20 on a good surface

// By triangle: which triangles to compare it with. Triangles at folds may intersect any other. In `places`, triangles
// may intersect others without a common corner: if two with a common corner intersect, one of them is at a fold.
LargeArray<Compared> suspects(const TriangleMesh& mesh, const Folds& folds, std::span<const TriangleBox> places) {
    LargeArray<Compared> suspected(mesh.triangles.size(), Compared::kNot, mesh.memory());
    for (const std::uint32_t n : folds.triangles) suspected[n] = Compared::kWithAll;
    folds.boxes.mark_in(
        places.size(), [&](std::size_t n) { return places[n]; }, suspected, Compared::kNotAdjacent);
    return suspected;
}

// The vertices of pairs, ascending.
std::vector<std::uint32_t> vertices_of(const Patch& patch, std::span<const TrianglePair> pairs) {
    std::vector<std::uint32_t> vertices;
    for (const TrianglePair& pair : pairs)
        for (const std::uint32_t n : {pair.first, pair.second})
            for (int corner = 0; corner < 3; ++corner) vertices.push_back(patch.triangles[n][corner]);
    sort_unique(vertices);
    return vertices;
}

// A parameter set for the repair of a place. The sets are tried in order until no triangles intersect.
struct Way {
    float push;    // how far a vertex is pushed inward in a round, in radii; 0: all rounds smooth
    int rings;     // so many rings of neighbours move, too
    int no_return; // in the first so many rounds, smoothing does not move vertices outward
};
constexpr std::array kWays{Way{0.005F, 0, kRounds / 2}, Way{0.005F, 2, 0}, Way{0.02F, 1, 0}, Way{0.0F, 2, 0}};

// Adds `rings` rings of neighbours to a set of vertices.
std::vector<std::uint32_t> grown(const Patch& patch, std::vector<std::uint32_t> vertices, int rings) {
    for (int ring = 0; ring < rings; ++ring) {
        const std::vector<std::uint32_t> before = vertices;
        for (const std::uint32_t vertex : before) {
            const std::span<const std::uint32_t> beside = patch.neighbours.of(vertex);
            vertices.insert(vertices.end(), beside.begin(), beside.end());
        }
        sort_unique(vertices);
    }
    return vertices;
}

// The motion of vertices in a round.
enum class Move { kInward, kSmoothInward, kSmooth };

Move move_of(int round, const Way& way) {
    if (way.push > 0.0F && round / kInTurn % 2 == 0) return Move::kInward;
    return round < way.no_return ? Move::kSmoothInward : Move::kSmooth;
}

glm::vec3 smooth_step(const Patch& patch, std::uint32_t vertex, const glm::vec3& normal, Move how) {
    const std::span<const std::uint32_t> neighbours = patch.neighbours.of(vertex);
    glm::vec3 middle(0.0F);
    for (const std::uint32_t other : neighbours)
        middle += patch.positions[other] / static_cast<float>(neighbours.size());
    const glm::vec3 step = kStep * (middle - patch.positions[vertex]);
    const float outward = std::max(glm::dot(step, normal), 0.0F);
    return how == Move::kSmoothInward ? step - outward * normal : step;
}

void move(Patch& patch, std::span<const std::uint32_t> moving, const TriangleMesh& mesh, const Way& way, int round) {
    const Move how = move_of(round, way);
    std::vector<glm::vec3> to;
    to.reserve(moving.size());
    for (const std::uint32_t vertex : moving) {
        const std::uint32_t n = patch.vertices[vertex];
        const glm::vec3 at = patch.positions[vertex];
        const glm::vec3 step = how == Move::kInward ? -way.push * mesh.radii[n] * mesh.normals[n]
                                                    : smooth_step(patch, vertex, mesh.normals[n], how);
        const glm::vec3 there = at + step;
        const bool may =
            patch.has_all[vertex] != 0 && glm::distance(there, mesh.positions[n]) < kFarthest * mesh.radii[n];
        to.push_back(may ? there : at);
    }
    for (std::size_t n = 0; n < moving.size(); ++n) patch.positions[moving[n]] = to[n];
}

// The pairs that intersect after vertices have moved. Triangles without moved vertices did not intersect before.
IntersectingTriangles meeting_at(const Patch& patch, std::span<const std::uint32_t> moved, Job& job) {
    std::vector<std::uint8_t> is_moved(patch.vertices.size(), 0);
    for (const std::uint32_t vertex : moved) is_moved[vertex] = 1;
    std::vector<Compared> compared;
    compared.reserve(patch.triangles.size());
    for (const glm::uvec3& t : patch.triangles)
        compared.push_back((is_moved[t.x] | is_moved[t.y] | is_moved[t.z]) != 0 ? Compared::kWithAll : Compared::kNot);
    IntersectionLimits limits;
    limits.looks = kMostLooks;
    return intersecting_triangles(TriangleBoxes(patch.positions, patch.triangles), compared, limits, job);
}

// The best state of a place, and the number of pairs that still intersect.
struct Drawn {
    std::vector<std::uint32_t> vertices; // of the surface
    std::vector<glm::vec3> positions;    // their new positions; empty if none moves
    std::size_t left = 0;
};

Drawn draw(const TriangleMesh& mesh, const IntersectionPlace& place, Job& job) {
    Drawn drawn{{}, {}, place.pairs.size()};
    if (place.pairs.size() > kMostPairs || place.triangles.size() > kMostTriangles) return drawn;
    Patch patch = patch_around(mesh, place);
    const std::vector<glm::vec3> before = patch.positions;
    for (const Way& way : kWays) {
        patch.positions = before;
        std::vector<TrianglePair> pairs = patch.pairs;
        for (int round = 0; round < kRounds && drawn.left > 0; ++round) {
            const std::vector<std::uint32_t> moving = grown(patch, vertices_of(patch, pairs), way.rings);
            move(patch, moving, mesh, way, round);
            IntersectingTriangles now = meeting_at(patch, moving, job);
            if (!now.looked_at_all) break;
            pairs = std::move(now.pairs);
            if (pairs.size() < drawn.left) drawn.left = pairs.size(), drawn.positions = patch.positions;
        }
    }
    drawn.vertices = std::move(patch.vertices);
    return drawn;
}

} // namespace

Untangled untangle(TriangleMesh& mesh, std::span<const TriangleBox> places, Job& job) {
    const Folds folds = find_folds(mesh);
    const IntersectingTriangles found =
        intersecting_triangles(folds.boxes, suspects(mesh, folds, places), {kMostListed, kMostLooks}, job);
    Untangled all{found.count, found.count, found.looked_at_all, {}};
    if (job.cancelled()) return all;
    const std::vector<IntersectionPlace> meeting = intersection_places(mesh, folds.boxes, found.pairs);
    std::vector<Drawn> drawn(meeting.size());
    tbb::parallel_for(std::size_t{0}, meeting.size(), [&](std::size_t n) { drawn[n] = draw(mesh, meeting[n], job); });
    if (job.cancelled()) return all;
    for (std::size_t n = 0; n < drawn.size(); ++n) {
        all.left -= meeting[n].pairs.size() - drawn[n].left;
        if (drawn[n].left > 0) all.places.push_back(mesh.positions[mesh.triangles[meeting[n].pairs.front().first].x]);
        for (std::size_t v = 0; v < drawn[n].positions.size(); ++v)
            mesh.positions[drawn[n].vertices[v]] = drawn[n].positions[v];
    }
    return all;
}

} // namespace ramus::mesh
