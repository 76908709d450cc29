// Neighbours: what lies in the 26 directions around a brick.
#pragma once

#include "core/base/chunked_array.h"
#include "core/mesh/polygonize/octree/octree.h"

#include <array>
#include <cstdint>
#include <cstring>
#include <span>
#include <utility>
#include <vector>

namespace ramus::mesh::bricks {

constexpr int direction_index(int x, int y, int z) { return (x + 1) + 3 * (y + 1) + 9 * (z + 1); }
inline constexpr int kDirections = 27;
inline constexpr int kSelf = 13;

// The 27 entries of a cube and around it, by direction. An entry larger than the cube stands in every direction that it
// covers.
struct EntriesAround {
    std::array<OctreeEntry, 32> at; // kDirections of them count
    std::uint32_t larger = 0;       // one bit per direction: the entry, empty or not, is larger
};

// The 4 x 4 x 4 entries at the size of a cube's children: around all eight of them. Reading a row that begins at its
// second entry may end one beyond the last.
struct EntriesAroundChildren {
    std::array<OctreeEntry, 65> at;
    std::uint64_t larger = 0;
};

// Along one axis the children around a cube's children are those of the cubes -1, 0 and 1 (0, 1, 2 here), as child 0 or
// 1.
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

// Directions: one of -1, 0, 1 along every axis.

// Absent: free of surface. Finer: smaller bricks are there, though some, or all that touch, may be free of surface.
enum class Neighbour : std::uint8_t { kAbsent, kSame, kCoarser, kFiner };

struct Neighbourhood {
    std::array<std::uint32_t, kDirections> brick; // set where there is one of the same size or a larger one
    std::uint32_t same, coarser, finer;           // one bit per direction
    std::uint32_t full;                           // absent because all of it is inside the surface

    [[nodiscard]] Neighbour kind(int direction) const {
        const std::uint32_t bit = std::uint32_t{1} << direction;
        if ((same & bit) != 0) return Neighbour::kSame;
        if ((coarser & bit) != 0) return Neighbour::kCoarser;
        return (finer & bit) != 0 ? Neighbour::kFiner : Neighbour::kAbsent;
    }
};

// Fills in `found`, by brick, for the bricks of some subtrees. A walk down the octree: the entries around a child are
// children of the entries around its parent.
void find_neighbours(const Octree& octree, std::span<const std::uint32_t> subtrees, ChunkedArray<Neighbourhood>& found);

// What lies around one brick of the octree.
[[nodiscard]] Neighbourhood neighbourhood_of(const Octree& octree, std::uint32_t brick);
// The brick that has a cube of one lattice unit, by the cube's lower corner; kNoBrick where there is none.
inline constexpr std::uint32_t kNoBrick = 0xFFFFFFFFU;
[[nodiscard]] std::uint32_t brick_at(const Octree& octree, const glm::ivec3& unit);

// One step of finding them: the bricks at and below the entry in the middle of `around`. There is memory for them in
// `found`.
void describe_bricks(const Octree& octree, const EntriesAround& around, ChunkedArray<Neighbourhood>& found);

// Pairs of subtrees that touch each other, in no order; a pair may come twice.
[[nodiscard]] std::vector<std::pair<std::uint32_t, std::uint32_t>> touching_subtrees(const Octree& octree);

// What an update of the octree changed.
struct OctreeChanges {
    std::vector<std::uint8_t> subtrees;        // by subtree: new, or to be taken for new
    std::vector<std::uint8_t> below;           // by upper node: something below it is new or gone
    std::vector<std::uint8_t> children;        // by upper node, one bit per child: it is new or gone
    std::vector<std::uint32_t> added, removed; // subtrees

    void mark(const Octree& octree, std::uint32_t upper); // `below`, up to the root
};

// Subtrees that touch something changed, and are not marked as changed themselves, in order.
[[nodiscard]] std::vector<std::uint32_t> subtrees_beside(const Octree& octree, const OctreeChanges& changes);

} // namespace ramus::mesh::bricks
