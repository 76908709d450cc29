// BrickGrid: the field at the 5 x 5 x 5 grid points of one brick after another. A brick owns the points below its upper
// sides; its upper neighbours own the others. Bricks of a subtree are processed from the last to the first, so that
// most points of upper neighbours are already sampled. For an absent neighbour the side of the surface is known. Only
// the remaining points are sampled.
#pragma once

#include "core/field/field.h"
#include "core/mesh/polygonize/cells/brick_cells.h"

#include <array>
#include <cstdint>

namespace ramus::mesh::bricks {

class BrickGrid {
public:
    // Begins a subtree. sample() must then be called for its bricks from the last to the first.
    void begin(std::uint32_t first_brick, std::uint32_t brick_count);
    // `field` must have entered the brick.
    void sample(std::uint32_t brick, const Neighbourhood& neighbours, field::BrickField& field, SampleCounts& counts);

    [[nodiscard]] GridBits inside() const { return inside_; } // at or above the isovalue
    // Computes values(), which few bricks need.
    void assemble_values();
    [[nodiscard]] const field::GridValues& values() const { return values_; }

private:
    // A brick's own samples, and one bit each: inside the surface? In order x + 4 y + 16 z.
    struct OwnSamples {
        std::array<float, kCellsPerBrick> value;
        std::uint64_t inside;
    };
    // A part of the grid beyond the brick's own points, and the knowledge of it before sampling.
    struct UpperPart {
        const OwnSamples* neighbour = nullptr; // samples of the brick that owns the points, if known
        bool known = false;                    // all points are on one side of the surface
        bool full = false;                     // this side is the inside
    };
    [[nodiscard]] UpperPart upper_part(int x, int y, int z) const;

    void sample(unsigned groups, field::BrickField& field, SampleCounts& counts);
    void add_upper_sides(field::BrickField& field, SampleCounts& counts);
    void add_upper_edges(field::BrickField& field, SampleCounts& counts);
    void assemble_bits();

    std::uint32_t first_brick_ = 0, brick_count_ = 0; // of the subtree
    LargeArray<OwnSamples> own_;                      // by brick of the subtree; valid from the current brick on

    // State of the brick.
    std::uint32_t index_ = 0; // in the subtree
    const Neighbourhood* neighbours_ = nullptr;
    field::GridGroups samples_{}; // by group
    GridBits inside_ = 0;
    field::GridValues values_{};
};

} // namespace ramus::mesh::bricks
