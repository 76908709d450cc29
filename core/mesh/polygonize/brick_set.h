// BrickSet: the leaves of the octree that the surface may cross, in a fixed order, each with the list of segments whose
// support reaches it, and a hash to find what is beside a brick. A region without a brick is proven free of surface.
#pragma once

#include "core/base/job.h"
#include "core/field/sampling.h"
#include "core/mesh/polygonize/lattice.h"
#include "core/mesh/polygonize/sizing.h"

#include <array>
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
    // To be called once, when `bricks` is complete.
    void build_index();

    // A cube of the octree, as seen by bricks beside it: a brick itself, or the parent of bricks and of finer cubes.
    struct Cube {
        std::uint64_t key = 0;                 // place and level, packed
        std::uint32_t brick = kNone;           // the brick it is, if any
        std::array<std::uint32_t, 8> children; // bricks, kNone (free of surface or never reached) or kFiner
    };
    static constexpr std::uint32_t kFiner = 0xFFFFFFFEU; // a child that is split again
    // The cube with this corner and level, or nothing where there is no surface (or one of another level).
    [[nodiscard]] const Cube* find(glm::ivec3 corner, int level) const;

private:
    Cube& insert(glm::ivec3 corner, int level, bool& is_new);

    std::vector<Cube> cubes_;
    std::vector<std::uint32_t> slots_; // open addressing into cubes_, power of two
};

// Splits space around the field's supports until every brick's cells are as small as `sizing` asks, dropping what
// bounds of the field prove to be wholly inside or outside. Empty when cancelled.
[[nodiscard]] BrickSet build_bricks(const field::ConvolutionField& field, const field::CullingArrays& culling,
                                    const Sizing& sizing, Job& job);

// How often the finest cell fits into the box around the field, in powers of two; beyond kMaximumLevels the lattice
// would leave the range of its integers.
[[nodiscard]] int levels_needed(const field::ConvolutionField& field, const Sizing& sizing);
inline constexpr int kMaximumLevels = 18;

} // namespace ramus::mesh::bricks
