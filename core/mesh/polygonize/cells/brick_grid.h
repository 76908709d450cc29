// BrickGrid: the field at the 5 x 5 x 5 grid points of one brick after another. Those below a brick's upper sides are
// its own, the others its upper neighbours'. The bricks of a subtree come from the last to the first, so that most of
// the neighbours' points are there already; of a neighbour that is free of surface it is known on which side of the
// surface all points lie. What neither gives is sampled.
#pragma once

#include "core/field/field.h"
#include "core/mesh/polygonize/cells/brick_cells.h"

#include <array>
#include <cstdint>

namespace ramus::mesh::bricks {

class BrickGrid {
public:
    // A subtree's bricks come next, the last first.
    void begin(std::uint32_t first_brick, std::uint32_t brick_count);
    // `field` is in the brick.
    void sample(std::uint32_t brick, const Neighbourhood& neighbours, field::BrickField& field, SampleCounts& counts);

    [[nodiscard]] GridBits inside() const { return inside_; } // at or above the isovalue
    // Puts the values in the order of values(), which few bricks need.
    void assemble_values();
    [[nodiscard]] const field::GridValues& values() const { return values_; }

private:
    // A brick's own samples, and one bit each: inside the surface? In order x + 4 y + 16 z.
    struct OwnSamples {
        std::array<float, kCellsPerBrick> value;
        std::uint64_t inside;
    };
    // A part of the grid beyond the brick's own points: what is known of it before sampling.
    struct UpperPart {
        const OwnSamples* neighbour = nullptr; // whose own points these are, if they are there already
        bool known = false;                    // all on one side of the surface
        bool full = false;                     // that side is the inside
    };
    [[nodiscard]] UpperPart upper_part(int x, int y, int z) const;

    void sample(unsigned groups, field::BrickField& field, SampleCounts& counts);
    void add_upper_sides(field::BrickField& field, SampleCounts& counts);
    void add_upper_edges(field::BrickField& field, SampleCounts& counts);
    void assemble_bits();

    std::uint32_t first_brick_ = 0, brick_count_ = 0; // of the subtree
    LargeArray<OwnSamples> own_; // by brick of the subtree; those from the present one on are filled

    // Of the brick.
    std::uint32_t index_ = 0; // in the subtree
    const Neighbourhood* neighbours_ = nullptr;
    field::GridGroups samples_{}; // by group, wherever they come from
    GridBits inside_ = 0;
    field::GridValues values_{};
};

} // namespace ramus::mesh::bricks
