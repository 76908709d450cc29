// Places: what stands around a cube of the octree, and from that what stands around its children.
#pragma once

#include "core/mesh/polygonize/octree/octree.h"

#include <array>
#include <cstdint>
#include <cstring>

namespace ramus::mesh::bricks {

constexpr int direction_index(int x, int y, int z) { return (x + 1) + 3 * (y + 1) + 9 * (z + 1); }
inline constexpr int kDirections = 27;
inline constexpr int kSelf = 13;

// The 27 places around a cube, itself in the middle. What is larger than the cube stands in all the places it covers.
struct Places {
    std::array<OctreePlace, 32> at; // kDirections of them count
    std::uint32_t larger = 0;       // one bit per direction: what is there, or the nothing that is, is larger
};

// The 4 x 4 x 4 places at the size of a cube's children: around all eight of them. Reading a row that begins at its
// second place may end one beyond the last.
struct ChildPlaces {
    std::array<OctreePlace, 65> at;
    std::uint64_t larger = 0;
};

// Along one axis the children around a child lie in the parent's places -1, 0 and 1, as child 0 or 1.
struct ChildStep {
    std::uint8_t place, child;
};
inline constexpr std::array<ChildStep, 4> kChildSteps{ChildStep{0, 1}, ChildStep{1, 0}, ChildStep{1, 1},
                                                      ChildStep{2, 0}};

inline ChildPlaces places_of_children(const Octree& octree, const Places& around) {
    // The places of a child that lie in each place of its parent.
    static constexpr std::array<std::uint64_t, kDirections> kCovered = [] {
        std::array<std::uint64_t, kDirections> covered{};
        for (unsigned n = 0; n < 64; ++n) {
            const std::size_t place =
                kChildSteps[n & 3].place + 3U * kChildSteps[n >> 2 & 3].place + 9U * kChildSteps[n >> 4].place;
            covered[place] |= std::uint64_t{1} << n;
        }
        return covered;
    }();
    ChildPlaces places;
    std::array<OctreeNode, kDirections> repeated;
    std::array<const OctreePlace*, kDirections> children;
    for (std::size_t p = 0; p < kDirections; ++p) {
        const OctreePlace place = around.at[p];
        repeated[p].fill(place);
        children[p] = place.is_node() ? octree.nodes[place.index()].data() : repeated[p].data();
        places.larger |= place.is_node() ? 0 : kCovered[p];
    }
    OctreePlace* row = places.at.data();
    for (const ChildStep z : kChildSteps) {
        for (const ChildStep y : kChildSteps) {
            const OctreePlace* const* const parents = &children[3U * y.place + 9U * z.place];
            const unsigned child = 2U * y.child + 4U * z.child;
            row[0] = parents[0][child + 1];
            row[1] = parents[1][child];
            row[2] = parents[1][child + 1];
            row[3] = parents[2][child];
            row += 4;
        }
    }
    return places;
}

inline Places places_of_child(const ChildPlaces& all, std::size_t child) {
    Places places;
    const std::size_t first = (child & 1) + 4 * (child >> 1 & 1) + 16 * (child >> 2);
    for (std::size_t z = 0; z < 3; ++z) {
        for (std::size_t y = 0; y < 3; ++y) {
            const std::size_t from = first + 4 * y + 16 * z;
            const std::size_t to = 3 * y + 9 * z;
            std::memcpy(&places.at[to], &all.at[from], 4 * sizeof(OctreePlace)); // the fourth is overwritten
            places.larger |= static_cast<std::uint32_t>(all.larger >> from & 7U) << to;
        }
    }
    return places;
}

} // namespace ramus::mesh::bricks
