#include "core/mesh/untangle/patches.h"

#include "core/base/disjoint_sets.h"
#include "core/base/sort_unique.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <span>
#include <unordered_map>
#include <utility>

namespace ramus::mesh {

namespace {

constexpr float kReach = 4.0F; // how far a patch reaches beyond a pair, in the pair's longest side

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

// Fills in neighbours (ascending) and has_all. On a closed surface a vertex with an edge of only one triangle is at the
// end of the patch.
void connect(Patch& patch) {
    // Each triangle of an edge adds both ends to each other's list, so an inner edge is listed twice.
    Grouped<std::uint32_t> ends(patch.vertices.size(), [&](const auto& put) {
        for (const glm::uvec3& t : patch.triangles)
            for (int corner = 0; corner < 3; ++corner) {
                const std::uint32_t a = t[corner], b = t[(corner + 1) % 3];
                put(a, b), put(b, a);
            }
    });
    patch.has_all.assign(patch.vertices.size(), 1);
    for (std::size_t vertex = 0; vertex < patch.vertices.size(); ++vertex) {
        const std::span<std::uint32_t> its = ends.of(vertex);
        std::ranges::sort(its);
        for (std::size_t n = 0; n < its.size(); n += 2) {
            const bool twice = n + 1 < its.size() && its[n] == its[n + 1] && its[n] != vertex &&
                               (n + 2 == its.size() || its[n + 2] != its[n]);
            if (!twice) patch.has_all[vertex] = 0;
        }
    }
    patch.neighbours = Grouped<std::uint32_t>(patch.vertices.size(), [&](const auto& put) {
        for (std::size_t vertex = 0; vertex < patch.vertices.size(); ++vertex) {
            const std::span<const std::uint32_t> its = ends.of(vertex);
            for (std::size_t n = 0; n < its.size(); ++n)
                if (n == 0 || its[n] != its[n - 1]) put(vertex, its[n]);
        }
    });
}

// The index of a number in an ascending list.
std::uint32_t place_in(const std::vector<std::uint32_t>& list, std::uint32_t thing) {
    return static_cast<std::uint32_t>(std::ranges::lower_bound(list, thing) - list.begin());
}

} // namespace

std::vector<IntersectionPlace> intersection_places(const TriangleMesh& mesh, const TriangleBoxes& boxes,
                                                   std::span<const TrianglePair> pairs) {
    constexpr std::size_t kRemembered = 32; // pairs that follow each other have the same triangles around them
    DisjointSets together(pairs.size());
    std::unordered_map<std::uint32_t, std::uint32_t> pair_at; // by triangle, one that is around
    std::vector<std::pair<TriangleBox, std::uint32_t>> looked_at;
    for (std::uint32_t n = 0; n < pairs.size(); ++n) {
        const TriangleBox box = box_around(mesh, pairs[n]);
        const auto last = std::span(looked_at).last(std::min(kRemembered, looked_at.size()));
        const auto known = std::ranges::find_if(last, [&](const auto& other) { return other.first.contains(box); });
        if (known != last.end()) {
            together.join(n, known->second);
            continue;
        }
        looked_at.emplace_back(box, n);
        boxes.for_each_in(box, [&](std::uint32_t triangle) {
            const auto [at, fresh] = pair_at.try_emplace(triangle, n);
            if (!fresh) together.join(n, at->second);
        });
    }
    std::vector<IntersectionPlace> places;
    std::vector<std::uint32_t> place(pairs.size(), 0); // by the pair that stands for it
    for (std::uint32_t n = 0; n < pairs.size(); ++n) {
        const std::uint32_t first = together.find(n);
        if (first == n) place[n] = static_cast<std::uint32_t>(places.size()), places.emplace_back();
        places[place[first]].pairs.push_back(pairs[n]);
    }
    for (const auto& [triangle, pair] : pair_at) places[place[together.find(pair)]].triangles.push_back(triangle);
    for (IntersectionPlace& one : places) std::ranges::sort(one.triangles);
    return places;
}

Patch patch_around(const TriangleMesh& mesh, const IntersectionPlace& place) {
    Patch patch;
    for (const std::uint32_t n : place.triangles)
        for (int corner = 0; corner < 3; ++corner) patch.vertices.push_back(mesh.triangles[n][corner]);
    sort_unique(patch.vertices);
    for (const std::uint32_t vertex : patch.vertices) patch.positions.push_back(mesh.positions[vertex]);
    const auto here = [&](std::uint32_t vertex) { return place_in(patch.vertices, vertex); };
    for (const std::uint32_t n : place.triangles) {
        const glm::uvec3& t = mesh.triangles[n];
        patch.triangles.emplace_back(here(t.x), here(t.y), here(t.z));
    }
    for (const TrianglePair& pair : place.pairs)
        patch.pairs.push_back({place_in(place.triangles, pair.first), place_in(place.triangles, pair.second)});
    connect(patch);
    return patch;
}

} // namespace ramus::mesh
