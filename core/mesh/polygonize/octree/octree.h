// Octree: space around the vessels split until every leaf's cells are as small as the sizing asks, without what bounds
// of the field prove to be wholly inside or outside. Leaves become bricks, in depth-first Morton order.
#pragma once

#include "core/base/job.h"
#include "core/field/convolution_field.h"
#include "core/field/culling.h"
#include "core/mesh/polygonize/octree/lattice.h"
#include "core/mesh/polygonize/octree/sizing.h"

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace ramus::mesh::bricks {

struct Brick {
    glm::ivec3 corner{0}; // lattice units
    std::int32_t level = 0;
    std::uint32_t list_begin = 0; // into Octree::lists
    std::uint32_t list_count = 0;
};

// What is at a place of the octree: nothing that the surface could cross, a brick, or a node that is split.
class OctreePlace {
public:
    constexpr OctreePlace() = default;
    static constexpr OctreePlace brick(std::size_t index) { return OctreePlace(static_cast<std::uint32_t>(index)); }
    static constexpr OctreePlace node(std::size_t index) {
        return OctreePlace(static_cast<std::uint32_t>(index) | kNodeBit);
    }
    [[nodiscard]] constexpr bool is_empty() const { return code_ == kEmpty; }
    [[nodiscard]] constexpr bool is_node() const { return !is_empty() && (code_ & kNodeBit) != 0; }
    [[nodiscard]] constexpr bool is_brick() const { return (code_ & kNodeBit) == 0; }
    [[nodiscard]] constexpr std::uint32_t index() const { return code_ & ~kNodeBit; }
    // The same place when bricks and nodes are counted from other beginnings.
    [[nodiscard]] constexpr OctreePlace shifted(std::size_t bricks, std::size_t nodes) const {
        return is_empty() ? *this : OctreePlace(code_ + static_cast<std::uint32_t>(is_node() ? nodes : bricks));
    }

private:
    static constexpr std::uint32_t kEmpty = 0xFFFFFFFFU;
    static constexpr std::uint32_t kNodeBit = 0x80000000U;
    explicit constexpr OctreePlace(std::uint32_t code) : code_(code) {}
    std::uint32_t code_ = kEmpty;
};

using OctreeNode = std::array<OctreePlace, field::kChildren>;

struct Octree {
    Lattice lattice;
    int top_level = 0;
    std::vector<OctreeNode> nodes; // the root first, parents before their children
    std::size_t upper_nodes = 0;   // the first of them: those above `subtrees`
    std::vector<Brick> bricks;
    std::vector<std::uint32_t> lists; // segment indices, ascending within each brick
    [[nodiscard]] std::span<const std::uint32_t> segments_of(const Brick& brick) const {
        return {lists.data() + brick.list_begin, brick.list_count};
    }

    // Subtrees of like size, for working on them in parallel: they hold all bricks, in order.
    std::vector<std::pair<std::uint32_t, int>> subtrees; // parent node and child
};

// Without bricks when cancelled.
[[nodiscard]] Octree build_octree(const field::ConvolutionField& field, const field::CullingSegments& culling,
                                  const Sizing& sizing, Job& job);

// How often the finest cell fits into the box around the field, in powers of two; beyond kMaximumLevels the lattice
// would leave the range of its integers.
[[nodiscard]] int levels_needed(const field::ConvolutionField& field, const Sizing& sizing);
inline constexpr int kMaximumLevels = 18;

} // namespace ramus::mesh::bricks
