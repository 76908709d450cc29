// Splitter: what the eight children of a cube are, and how a subtree's bricks come of that. Shared by building an
// octree and by updating one.
#pragma once

#include "core/mesh/polygonize/octree/octree.h"

#include <array>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

namespace ramus::mesh::bricks {

using Indices = std::span<const std::uint32_t>;

// A cube of the octree with what of the tree concerns it: segments, and sizing pieces, or above the subtrees groups of
// them.
struct Cube {
    glm::ivec3 corner{0};
    int level = 0;
    Indices segments, pieces;
};

// The children of a cube that the surface may cross, and the memory of their lists.
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
    // With groups instead of pieces.
    void split_upper(const Cube& cube, Children& children) const { split(cube, children, true); }
    // The pieces of `groups` that ask a child of the cube for smaller cells, and whether there are any.
    [[nodiscard]] bool any_active(const Cube& cube, std::size_t child, Indices groups) const;
    void expand(const Cube& cube, std::size_t child, Indices groups, std::vector<std::uint32_t>& pieces) const;
    // Whether a cube as small as this is to be a subtree. Goes by its segments alone.
    [[nodiscard]] bool is_subtree(const Cube& cube) const;
    // Middle of a cube relative to the middle of the frame, and the edge of its children, mm.
    [[nodiscard]] glm::vec3 middle_of(const Cube& cube) const;
    [[nodiscard]] field::ChildCubes children_of(const Cube& cube) const {
        return {middle_of(cube), static_cast<float>(child_side(cube))};
    }
    [[nodiscard]] double child_side(const Cube& cube) const { return lattice.unit_mm * brick_units(cube.level - 1); }

private:
    void split(const Cube& cube, Children& children, bool upper) const;
};

// Where the lists begin: all that there is.
class RootLists {
public:
    RootLists(const field::Field& field, const Sizing& sizing) : segments_(field.skeleton().present()) {
        groups_.resize(sizing.groups.size());
        std::iota(groups_.begin(), groups_.end(), 0U);
    }
    [[nodiscard]] Cube root(int level) const { return {glm::ivec3(0), level, segments_, groups_}; }

private:
    std::span<const std::uint32_t> segments_;
    std::vector<std::uint32_t> groups_;
};

// A cube with lists of its own that is to become a subtree, or to be split on the way there. Child of an upper node.
struct Seed {
    Cube cube;
    bool is_brick = false, is_subtree = false;
    std::uint32_t parent = 0, child = 0;
    // A subtree that is there already, of which it is known that only its division into bricks may have changed.
    std::uint32_t present = UpperNode::kNothing;
    std::vector<std::uint32_t> segments, pieces; // what the cube's lists point to

    Seed() = default;
    // A child of `cube`, which was split with groups.
    Seed(const Splitter& splitter, const Cube& parent_cube, const Children& children, std::size_t c,
         std::uint32_t parent_node);
};

// Makes the subtrees of `seeds`, appends them to the octree, nodes, bricks, lists and all, and enters them under their
// parents. They are appended to octree.subtrees, in order. Leaves in `seeds` those that were
// entered: not those whose present subtree turned out as they would. Incomplete when cancelled.
void append_subtrees(const Splitter& splitter, std::vector<Seed>& seeds, Octree& octree, Job& job);

} // namespace ramus::mesh::bricks
