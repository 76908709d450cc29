// BrickSet: the leaves of the octree that the surface may cross, in a fixed order, each with the list of segments whose
// support reaches it, and a hash to find a brick by place and level. A region without a brick is proven free of surface.
#pragma once

#include "core/base/job.h"
#include "core/field/sampling.h"
#include "core/mesh/polygonize/lattice.h"
#include "core/mesh/polygonize/sizing.h"

#include <cstdint>
#include <span>
#include <vector>

namespace ramus::mesh::bricks {

inline constexpr std::uint32_t kNone = 0xFFFFFFFFU;

struct Brick {
    glm::ivec3 corner{0}; // lattice units
    std::int32_t level = 0;
    std::uint32_t list_begin = 0; // into BrickSet::lists
    std::uint32_t list_count = 0;
};

class BrickSet {
public:
    Lattice lattice;
    std::vector<Brick> bricks;
    std::vector<std::uint32_t> lists; // segment indices, ascending within each brick
    int top_level = 0;

    [[nodiscard]] std::span<const std::uint32_t> segments_of(const Brick& brick) const {
        return {lists.data() + brick.list_begin, brick.list_count};
    }
    // Index of the brick with this corner and level, or kNone.
    [[nodiscard]] std::uint32_t find(glm::ivec3 corner, int level) const;
    // To be called once, when `bricks` is complete.
    void build_index();

private:
    std::vector<std::uint32_t> slots_; // open addressing, power of two
};

// Splits space around the field's supports until every brick's cells are as small as `sizing` asks, dropping what bounds
// of the field prove to be wholly inside or outside. Empty when cancelled.
[[nodiscard]] BrickSet build_bricks(const field::ConvolutionField& field, const field::CullingArrays& culling,
                                    const Sizing& sizing, Job& job);

// How often the finest cell fits into the box around the field, in powers of two; beyond kMaximumLevels the lattice would
// leave the range of its integers.
[[nodiscard]] int levels_needed(const field::ConvolutionField& field, const Sizing& sizing);
inline constexpr int kMaximumLevels = 25;

} // namespace ramus::mesh::bricks
