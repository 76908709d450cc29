#include "core/measure/deviation/packed_triangles.h"

#include "core/measure/deviation/packed_queries.h"

#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/parallel_sort.h>

namespace ramus::measure {

namespace {

constexpr std::size_t kGrain = 4096; // things for a thread at once

// Spreads the lowest 16 bits, with two zeros after each.
std::uint64_t spread(std::uint32_t bits) {
    std::uint64_t x = bits & 0xFFFFU;
    x = (x | x << 16U) & 0x0000FF0000FFULL;
    x = (x | x << 8U) & 0x00F00F00F00FULL;
    x = (x | x << 4U) & 0x0C30C30C30C3ULL;
    return (x | x << 2U) & 0x249249249249ULL;
}

// The index of a cell on the Hilbert curve through a cube of 2^16 cells a side (J. Skilling, "Programming the Hilbert
// curve", AIP Conference Proceedings 707, 2004).
std::uint64_t hilbert_index(std::array<std::uint32_t, 3> x) {
    constexpr std::uint32_t kBits = 16, kTop = 1U << (kBits - 1);
    for (std::uint32_t bit = kTop; bit > 1; bit >>= 1U) {
        const std::uint32_t below = bit - 1;
        for (std::uint32_t& coordinate : x) { // without branches, which nobody could foresee
            const std::uint32_t turned = (coordinate & bit) != 0 ? 0xFFFFFFFFU : 0U;
            const std::uint32_t change = (x[0] ^ coordinate) & below & ~turned;
            coordinate ^= change;
            x[0] ^= change ^ (below & turned);
        }
    }
    x[1] ^= x[0];
    x[2] ^= x[1];
    std::uint32_t parity = 0;
    for (std::uint32_t bit = kTop; bit > 1; bit >>= 1U)
        if ((x[2] & bit) != 0) parity ^= bit - 1;
    return spread(x[0] ^ parity) << 2U | spread(x[1] ^ parity) << 1U | spread(x[2] ^ parity);
}

template <class Call> void for_all(std::size_t count, const Call& call) {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, kGrain), [&](const auto& range) {
        for (std::size_t i = range.begin(); i < range.end(); ++i) call(i);
    });
}

Bounds<glm::vec3> box_of(const PackedLeaf& leaf) {
    Bounds<glm::vec3> box;
    for (std::uint32_t n = 0; n < kPack; ++n)
        for (const auto& corner : leaf.corner) box.hold({corner[0][n], corner[1][n], corner[2][n]});
    return box;
}

// The numbers 0 to count - 1, sorted by place(n) along a Hilbert curve through the bounding box. Calls place() twice
// for each number, and stores no places.
template <class PlaceAt>
LargeArray<std::uint32_t> hilbert_order(std::size_t count, const LargeAllocator<std::byte>& memory,
                                        const PlaceAt& place_at) {
    Bounds<glm::vec3> box;
    for (std::size_t i = 0; i < count; ++i) box.hold(place_at(i));
    const glm::dvec3 least(box.least), size = glm::dvec3(box.most) - least;
    const double side = std::max({size.x, size.y, size.z});
    const double scale = side > 0.0 ? 65535.0 / side : 0.0;
    struct Key {
        std::uint64_t index;
        std::uint32_t place;
    };
    LargeArray<Key> keys(count, memory);
    for_all(count, [&](std::size_t i) {
        const glm::dvec3 cell = scale * (glm::dvec3(place_at(i)) - least);
        keys[i] = {hilbert_index({static_cast<std::uint32_t>(cell.x), static_cast<std::uint32_t>(cell.y),
                                  static_cast<std::uint32_t>(cell.z)}),
                   static_cast<std::uint32_t>(i)};
    });
    tbb::parallel_sort(keys.begin(), keys.end(), [](const Key& a, const Key& b) {
        return a.index < b.index || (a.index == b.index && a.place < b.place);
    });
    LargeArray<std::uint32_t> order(count, memory);
    for_all(count, [&](std::size_t i) { order[i] = keys[i].place; });
    return order;
}

} // namespace

PackedTriangles::PackedTriangles(const mesh::TriangleMesh& mesh, std::size_t most_copied,
                                 const LargeAllocator<std::byte>& memory)
    : leaves_(memory) {
    const std::size_t count = mesh.triangles.size();
    order_ = hilbert_order(count, memory, [&](std::size_t i) {
        const glm::uvec3& t = mesh.triangles[i];
        const glm::vec3 &a = mesh.positions[t.x], &b = mesh.positions[t.y], &c = mesh.positions[t.z];
        return 0.5F * (glm::min(glm::min(a, b), c) + glm::max(glm::max(a, b), c));
    });
    view_.positions = mesh.positions.data();
    view_.triangles = mesh.triangles.data();
    view_.order = order_.data();
    view_.count = count;
    const std::size_t leaves = (count + kPack - 1) / kPack;
    if (count <= most_copied) {
        leaves_.resize(leaves);
        for_all(leaves, [&](std::size_t leaf) { fill_leaf(view_, leaf, leaves_[leaf]); });
        view_.leaves = leaves_.data();
    }
    const auto box_of_leaf = [this](std::size_t number) {
        if (view_.leaves != nullptr) return box_of(view_.leaves[number]);
        PackedLeaf leaf;
        fill_leaf(view_, number, leaf);
        return box_of(leaf);
    };
    tree_.emplace(BoxTree::level_of(leaves, box_of_leaf, memory));
    for (const BoxTree::Level& level : tree_->levels()) view_.levels[view_.level_count++] = level.data();
}

LargeArray<double> PackedTriangles::distances(std::span<const glm::vec3> points) const {
    const LargeArray<std::uint32_t> order = hilbert_order(points.size(), {}, [&](std::size_t i) { return points[i]; });
    LargeArray<double> distances(points.size());
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, points.size(), kGrain), [&](const auto& range) {
        packed_distances(view_, points.data(), order.data() + range.begin(), range.size(), distances.data());
    });
    return distances;
}

void PackedTriangles::crossings(const glm::dvec3& from, const glm::dvec3& direction, double length,
                                std::vector<Crossing>& found) const {
    found.resize(std::max<std::size_t>(found.capacity(), 16));
    std::size_t count = packed_crossings(view_, &from.x, &direction.x, length, found.data(), found.size());
    if (count > found.size()) {
        found.resize(count);
        count = packed_crossings(view_, &from.x, &direction.x, length, found.data(), found.size());
    }
    found.resize(count);
    std::ranges::sort(
        found, [](const Crossing& a, const Crossing& b) { return a.at < b.at || (a.at == b.at && a.out < b.out); });
    // A line through an edge or a corner intersects all triangles there, at one place.
    const double same = 1e-12 * (glm::length(from) + length);
    const auto repeats = std::unique(found.begin(), found.end(), [&](const Crossing& a, const Crossing& b) {
        return a.out == b.out && b.at - a.at <= same;
    });
    found.erase(repeats, found.end());
    for (Crossing& crossing : found)
        crossing.triangle = order_[std::min<std::size_t>(crossing.triangle, order_.size() - 1)];
}

Crossing PackedTriangles::first_exit(const glm::dvec3& from, const glm::dvec3& direction, double after) const {
    Crossing exit = packed_exit(view_, &from.x, &direction.x, after);
    exit.triangle = order_[std::min<std::size_t>(exit.triangle, order_.size() - 1)];
    return exit;
}

} // namespace ramus::measure
