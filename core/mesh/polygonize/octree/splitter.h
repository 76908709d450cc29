// Splitter: decides for the eight children of a cube whether they are outside, inside, a brick, or must be divided, and
// builds the bricks of subtrees. Used to build an octree and to update one.
#pragma once

#include "core/mesh/polygonize/octree/octree.h"

#include <array>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

namespace ramus::mesh::bricks {

using Indices = std::span<const std::uint32_t>;

// A cube of the octree with the segments that reach it and the sizing pieces that may require smaller cells. Above the
// subtrees `pieces` are groups.
struct Cube {
    glm::ivec3 corner{0};
    int level = 0;
    Indices segments, pieces;
};

// The children of a cube, with the memory of their lists.
struct Children {
    enum class Verdict { kOutside, kInside, kBrick, kSplit };
    std::array<Verdict, field::kChildren> verdicts{};
    std::array<Cube, field::kChildren> cubes;

    std::vector<std::uint32_t> segments, pieces;
    std::vector<std::uint8_t> bits;
};

struct Splitter {
    const field::Field& field;
    const Sizing& sizing;
    const Lattice& lattice;

    void split(const Cube& cube, Children& children) const { split(cube, children, false); }
    // The same for a cube whose pieces are groups.
    void split_upper(const Cube& cube, Children& children) const { split(cube, children, true); }
    // Whether any piece of `groups` requires smaller cells in a child of the cube; and the list of these pieces.
    [[nodiscard]] bool any_active(const Cube& cube, std::size_t child, Indices groups) const;
    void expand(const Cube& cube, std::size_t child, Indices groups, std::vector<std::uint32_t>& pieces) const;
    // Whether a cube is small enough to be a subtree. Depends only on its segments.
    [[nodiscard]] bool is_subtree(const Cube& cube) const;
    // The middle of a cube relative to the middle of the extent (mm), and the edge of its children (mm).
    [[nodiscard]] glm::vec3 middle_of(const Cube& cube) const;
    [[nodiscard]] field::ChildCubes children_of(const Cube& cube) const {
        return {middle_of(cube), static_cast<float>(child_side(cube))};
    }
    [[nodiscard]] double child_side(const Cube& cube) const { return lattice.unit_mm * brick_units(cube.level - 1); }

private:
    void split(const Cube& cube, Children& children, bool upper) const;
};

// The lists of the top cube: all segments and all groups.
class TopLists {
public:
    TopLists(const field::Field& field, const Sizing& sizing) : segments_(field.skeleton().present()) {
        groups_.resize(sizing.groups.size());
        std::iota(groups_.begin(), groups_.end(), 0U);
    }
    [[nodiscard]] Cube top_cube(int level) const { return {glm::ivec3(0), level, segments_, groups_}; }

private:
    std::span<const std::uint32_t> segments_;
    std::vector<std::uint32_t> groups_;
};

// A child of an upper node, with lists of its own, that will become a subtree, or be divided further.
struct Seed {
    Cube cube;
    bool is_brick = false, is_subtree = false;
    std::uint32_t parent = 0, child = 0;
    // An existing subtree at this place in which only the division into bricks may have changed.
    std::uint32_t present = UpperNode::kNothing;
    // The subtree at this place that was entered without bricks, and gets them now.
    std::uint32_t entered = UpperNode::kNothing;
    std::vector<std::uint32_t> segments, pieces; // the memory of the cube's lists

    Seed() = default;
    // Child `c` of `parent_cube`, which was divided with groups.
    Seed(const Splitter& splitter, const Cube& parent_cube, const Children& children, std::size_t c,
         std::uint32_t parent_node);
};

// Builds the subtrees of `seeds`, appends them with their nodes, bricks and lists to the octree, in order, and links
// them to their parents. A seed whose present subtree is unchanged is skipped and removed from `seeds`. Incomplete if
// cancelled.
void append_subtrees(const Splitter& splitter, std::vector<Seed>& seeds, Octree& octree, Job& job);

// What a subtree holds, counted without keeping it.
struct SubtreeSize {
    std::uint32_t bricks = 0;
    std::uint32_t parted = 0;   // bricks in which vessels may be kept apart
    std::uint64_t segments = 0; // in the lists of all bricks
};
[[nodiscard]] SubtreeSize size_of_subtree(const Splitter& splitter, const Seed& seed);

} // namespace ramus::mesh::bricks
