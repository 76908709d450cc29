// Octree: divides the space around the vessels until the cells of every leaf are as small as the sizing requires. Cubes
// that bounds of the field prove to be inside or outside of the surface are left out. The remaining leaves are the
// bricks, in depth-first Morton order.
#pragma once

#include "core/base/bounds.h"
#include "core/base/job.h"
#include "core/base/large_array.h"
#include "core/field/field.h"
#include "core/mesh/polygonize/octree/lattice.h"
#include "core/mesh/polygonize/octree/sizing.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace ramus::mesh::bricks {

struct Brick {
    glm::ivec3 corner{0}; // lattice units
    std::int32_t level = 0;
    std::uint32_t list_begin = 0; // into Octree::lists
    std::uint32_t list_count = 0;
    std::uint32_t subtree = 0; // into Octree::subtrees
};

// An entry of the octree, the child of a node: empty (no surface; all inside or all outside), a brick, or a divided
// node.
class OctreeEntry {
public:
    constexpr OctreeEntry() = default;
    static constexpr OctreeEntry brick(std::size_t index) { return OctreeEntry(static_cast<std::uint32_t>(index)); }
    static constexpr OctreeEntry node(std::size_t index) {
        return OctreeEntry(static_cast<std::uint32_t>(index) | kNodeBit);
    }
    static constexpr OctreeEntry full() { return OctreeEntry(kFull); }
    [[nodiscard]] constexpr bool is_empty() const { return code_ >= kFull; }
    [[nodiscard]] constexpr bool is_full() const { return code_ == kFull; } // empty, and inside the surface
    [[nodiscard]] constexpr bool is_node() const { return !is_empty() && (code_ & kNodeBit) != 0; }
    [[nodiscard]] constexpr bool is_brick() const { return (code_ & kNodeBit) == 0; }
    [[nodiscard]] constexpr std::uint32_t index() const { return code_ & ~kNodeBit; }
    // The same entry with offsets added to the indices of bricks and nodes.
    [[nodiscard]] constexpr OctreeEntry shifted(std::size_t bricks, std::size_t nodes) const {
        return is_empty() ? *this : OctreeEntry(code_ + static_cast<std::uint32_t>(is_node() ? nodes : bricks));
    }

private:
    static constexpr std::uint32_t kEmpty = 0xFFFFFFFFU;
    static constexpr std::uint32_t kFull = 0xFFFFFFFEU;
    static constexpr std::uint32_t kNodeBit = 0x80000000U;
    explicit constexpr OctreeEntry(std::uint32_t code) : code_(code) {}
    std::uint32_t code_ = kEmpty;
};

using OctreeNode = std::array<OctreeEntry, field::kChildren>;

// A part of the octree that one task processes as a whole: a single brick, or a node with everything below it, at most
// kSubtreeLevels levels above its finest bricks. Its extent depends only on the local segments.
struct Subtree {
    std::uint32_t parent = 0, child = 0; // index of its parent in Octree::upper, and which child it is
    std::uint32_t first_brick = 0, brick_count = 0;
    glm::ivec3 corner{0};
    std::int32_t level = 0; // the level of a brick of the same size
};
inline constexpr int kSubtreeLevels = 3;

// A node above the subtrees. A child is nothing, another upper node, or a subtree.
struct UpperNode {
    std::uint32_t node = 0;   // index in Octree::nodes
    std::uint32_t parent = 0; // index in Octree::upper; the top node is its own parent
    std::array<std::uint32_t, field::kChildren> children{};

    static constexpr std::uint32_t kNothing = 0xFFFFFFFFU;
    static constexpr std::uint32_t kNodeBit = 0x80000000U;
    static constexpr std::uint32_t subtree(std::size_t index) { return static_cast<std::uint32_t>(index); }
    static constexpr std::uint32_t node_code(std::uint32_t index) { return index | kNodeBit; }
    static constexpr bool is_subtree(std::uint32_t code) { return (code & kNodeBit) == 0; }
    static constexpr bool is_node(std::uint32_t code) { return code != kNothing && (code & kNodeBit) != 0; }
    static constexpr std::uint32_t node_of(std::uint32_t code) { return code & ~kNodeBit; }
};

// After build_octree() all arrays are in depth-first order. An update appends new entries and leaves removed ones in
// their place, unreferenced, so that no index changes.
struct Octree {
    Octree() = default;
    explicit Octree(const LargeAllocator<std::byte>& memory) : nodes(memory), bricks(memory), lists(memory) {}

    Lattice lattice;
    int top_level = 0;
    LargeArray<OctreeNode> nodes; // the top node first
    std::vector<UpperNode> upper; // the top node first
    std::vector<Subtree> subtrees;
    LargeArray<Brick> bricks;
    LargeArray<std::uint32_t> lists; // segment indices, ascending within each brick
    [[nodiscard]] std::span<const std::uint32_t> segments_of(const Brick& brick) const {
        return {lists.data() + brick.list_begin, brick.list_count};
    }

    std::uint32_t add_upper_node();
    void enter(std::uint32_t parent, std::size_t child, std::uint32_t upper_node); // indices of `upper`
    [[nodiscard]] std::vector<std::uint32_t> subtrees_in_order() const;            // depth first
};

[[nodiscard]] Bounds<glm::vec3> box_of_brick(const Octree& octree, std::uint32_t brick); // mm

// Builds the octree of a field. If cancelled, it has no bricks.
[[nodiscard]] Octree build_octree(const field::Field& field, const Sizing& sizing, Job& job,
                                  const LargeAllocator<std::byte>& memory = {});

// An octree with its lattice, and without any entry.
[[nodiscard]] Octree begin_octree(const field::Field& field, const Sizing& sizing,
                                  const LargeAllocator<std::byte>& memory = {});

// The number of levels from the finest cell to the box around the field. Beyond kMaximumLevels the coordinates of the
// lattice overflow.
[[nodiscard]] int levels_needed(const field::Extent& extent, const Sizing& sizing);
inline constexpr int kMaximumLevels = 18;

} // namespace ramus::mesh::bricks
