// Neighbours: what lies in the 26 directions around a brick.
#pragma once

#include "core/base/chunked_array.h"
#include "core/mesh/polygonize/octree/entries_around.h"
#include "core/mesh/polygonize/octree/octree.h"

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace ramus::mesh::bricks {

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

// One step of it: the bricks at and below the entry in the middle of `around`. There is memory for them in `found`.
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
