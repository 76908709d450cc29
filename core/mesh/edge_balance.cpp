#include "core/mesh/edge_balance.h"

#include "core/base/scattered.h"

#include <algorithm>
#include <cstdio>
#include <string>

namespace ramus::mesh {

namespace {

constexpr unsigned kPlaceBits = 10; // of the vertices of a place

} // namespace

void EdgeBalance::add(std::span<const glm::uvec3> triangles, const VertexSpan& vertices) {
    places_.resize(std::max(places_.size(), (vertices.size() >> kPlaceBits) + 1));
    for (const glm::uvec3& t : triangles)
        for (int corner = 0; corner < 3; ++corner) {
            const std::uint32_t from = t[corner], to = t[(corner + 1) % 3];
            const auto [low, high] = std::minmax(from, to);
            const std::uint64_t edge = scattered(std::uint64_t{low} << 32 | high);
            Place& place = places_[low >> kPlaceBits];
            place.sum += from < to ? edge : 0 - edge;
            place.at = vertices.positions[low];
        }
}

Result<void> EdgeBalance::check() const {
    const auto is_open = [](const Place& place) { return place.sum != 0; };
    const auto first = std::ranges::find_if(places_, is_open);
    if (first == places_.end()) return {};
    const auto others = std::ranges::count_if(places_, is_open) - 1;
    char position[96];
    std::snprintf(position, sizeof position, "(%g, %g, %g)", double(first->at.x), double(first->at.y),
                  double(first->at.z));
    return fail("the surface is not closed near " + std::string(position) +
                    (others > 0
                         ? ", and at " + std::to_string(others) + (others == 1 ? " other place" : " other places")
                         : std::string()),
                {}, "this is a fault of the program: report it with the tree; another --detail may avoid it");
}

Result<void> check_balance(const TriangleMesh& mesh) {
    EdgeBalance balance;
    balance.add(mesh.triangles, vertices_of(mesh));
    return balance.check();
}

} // namespace ramus::mesh
