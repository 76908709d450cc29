// Neighbours: the bricks (or empty space) in the 26 directions around a brick.
#pragma once

#include "core/base/chunked_array.h"
#include "core/base/large_array.h"
#include "core/mesh/polygonize/octree/octree.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <utility>
#include <vector>

namespace ramus::mesh::bricks {

constexpr int direction_index(int x, int y, int z) { return (x + 1) + 3 * (y + 1) + 9 * (z + 1); }
inline constexpr int kDirections = 27;
inline constexpr int kSelf = 13;

// The 27 octree entries at and around a cube, by direction. An entry larger than the cube occurs in every direction
// that it covers.
struct EntriesAround {
    std::array<OctreeEntry, 32> at; // kDirections of them are used
    std::uint32_t larger = 0;       // one bit per direction: the entry, empty or not, is larger
};

// The 4 x 4 x 4 entries of the size of a cube's children, around all eight children. Has one more entry, since copying
// a row reads four entries.
struct EntriesAroundChildren {
    std::array<OctreeEntry, 65> at;
    std::uint64_t larger = 0;
};

// Along one axis: which child (0 or 1) of which cube (-1, 0 or 1, stored as 0, 1, 2) each of the four entries is.
struct ChildStep {
    std::uint8_t cube, child;
};
inline constexpr std::array<ChildStep, 4> kChildSteps{ChildStep{0, 1}, ChildStep{1, 0}, ChildStep{1, 1},
                                                      ChildStep{2, 0}};

inline EntriesAroundChildren entries_around_children(const Octree& octree, const EntriesAround& around) {
    // The entries at the size of the children that each entry around the parent covers.
    static constexpr std::array<std::uint64_t, kDirections> kCovered = [] {
        std::array<std::uint64_t, kDirections> covered{};
        for (unsigned n = 0; n < 64; ++n) {
            const std::size_t cube =
                kChildSteps[n & 3].cube + 3U * kChildSteps[n >> 2 & 3].cube + 9U * kChildSteps[n >> 4].cube;
            covered[cube] |= std::uint64_t{1} << n;
        }
        return covered;
    }();
    EntriesAroundChildren entries;
    std::array<OctreeNode, kDirections> repeated;
    std::array<const OctreeEntry*, kDirections> children;
    for (std::size_t p = 0; p < kDirections; ++p) {
        const OctreeEntry entry = around.at[p];
        repeated[p].fill(entry);
        children[p] = entry.is_node() ? octree.nodes[entry.index()].data() : repeated[p].data();
        entries.larger |= entry.is_node() ? 0 : kCovered[p];
    }
    OctreeEntry* row = entries.at.data();
    for (const ChildStep z : kChildSteps) {
        for (const ChildStep y : kChildSteps) {
            const OctreeEntry* const* const parents = &children[3U * y.cube + 9U * z.cube];
            const unsigned child = 2U * y.child + 4U * z.child;
            row[0] = parents[0][child + 1];
            row[1] = parents[1][child];
            row[2] = parents[1][child + 1];
            row[3] = parents[2][child];
            row += 4;
        }
    }
    return entries;
}

inline EntriesAround entries_around_child(const EntriesAroundChildren& all, std::size_t child) {
    EntriesAround entries;
    const std::size_t first = (child & 1) + 4 * (child >> 1 & 1) + 16 * (child >> 2);
    for (std::size_t z = 0; z < 3; ++z) {
        for (std::size_t y = 0; y < 3; ++y) {
            const std::size_t from = first + 4 * y + 16 * z;
            const std::size_t to = 3 * y + 9 * z;
            std::memcpy(&entries.at[to], &all.at[from], 4 * sizeof(OctreeEntry)); // the fourth is overwritten
            entries.larger |= static_cast<std::uint32_t>(all.larger >> from & 7U) << to;
        }
    }
    return entries;
}

// A direction is -1, 0 or 1 along every axis.

// kAbsent: no surface there. kFiner: a divided cube; some of its bricks, or all that touch, may be absent.
enum class Neighbour : std::uint8_t { kAbsent, kSame, kCoarser, kFiner };

struct Neighbourhood {
    std::array<std::uint32_t, kDirections> brick; // valid for directions in `same` and `coarser`
    std::uint32_t same, coarser, finer;           // one bit per direction
    std::uint32_t full;                           // one bit per direction: absent, and inside the surface

    [[nodiscard]] Neighbour kind(int direction) const {
        const std::uint32_t bit = std::uint32_t{1} << direction;
        if ((same & bit) != 0) return Neighbour::kSame;
        if ((coarser & bit) != 0) return Neighbour::kCoarser;
        return (finer & bit) != 0 ? Neighbour::kFiner : Neighbour::kAbsent;
    }
};

// Finds the neighbourhoods of the bricks of some subtrees, by brick. Descends the octree: the entries around a child
// are children of the entries around its parent.
void find_neighbours(const Octree& octree, std::span<const std::uint32_t> subtrees, ChunkedArray<Neighbourhood>& found);

// The neighbourhood of one brick.
[[nodiscard]] Neighbourhood neighbourhood_of(const Octree& octree, std::uint32_t brick);
// The brick that contains a cube of one lattice unit, given by the cube's lower corner; kNoBrick if there is none.
inline constexpr std::uint32_t kNoBrick = 0xFFFFFFFFU;
[[nodiscard]] std::uint32_t brick_at(const Octree& octree, const glm::ivec3& unit);

// A step of find_neighbours(): the bricks at and below the entry in the middle of `around`. `found` must have room.
void describe_bricks(const Octree& octree, const EntriesAround& around, ChunkedArray<Neighbourhood>& found);

// Pairs of subtrees that touch each other, in no particular order; a pair may occur twice.
[[nodiscard]] LargeArray<std::pair<std::uint32_t, std::uint32_t>>
touching_subtrees(const Octree& octree, const LargeAllocator<std::byte>& memory = {});

// The changes that an update made to the octree.
struct OctreeChanges {
    std::vector<std::uint8_t> subtrees;        // by subtree: whether it is new, or must be treated as new
    std::vector<std::uint8_t> below;           // by upper node: whether something below it was added or removed
    std::vector<std::uint8_t> children;        // by upper node, one bit per child: whether it was added or removed
    std::vector<std::uint32_t> added, removed; // subtrees

    void mark(const Octree& octree, std::uint32_t upper); // sets `below` of an upper node and its ancestors
};

// The unmarked subtrees that touch something changed, in order.
[[nodiscard]] std::vector<std::uint32_t> subtrees_beside(const Octree& octree, const OctreeChanges& changes);

} // namespace ramus::mesh::bricks
