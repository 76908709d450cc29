// LocalSegments: the segments that matter to one small cube of space, side by side in memory and in single precision as
// seen from the cube's corner. Gathered once for a brick, then used by all that samples the field there.
#pragma once

#include "core/field/brick_field.h"
#include "core/field/kernel.h"
#include "core/field/skeleton.h"

#include <cstdint>
#include <span>
#include <vector>

namespace ramus::field {

struct LocalSegments {
    const Kernel* kernel = nullptr;
    const FieldSegment* segments = nullptr; // of the whole field
    GridAxes axes;
    std::size_t count = 0;
    SegmentIndices list;

    // By segment. The arrays go on for at least a vector's width.
    std::vector<float> x, y, z; // start relative to the corner, mm
    std::vector<float> ux, uy, uz, length, radius, slope, beyond;
    std::vector<std::int32_t> branch;
    std::vector<float> excess, excess_slope; // of the tree's radius, as in FieldSegment
    bool has_excess = false;                 // of any segment
    // Coordinates of the grid seen from the segment's start: 8 along x, 8 along y, 8 along z. Rounded once from double
    // precision: the same point of space gives the same float whatever the grid it is taken from.
    static constexpr std::size_t kTableStride = 32;
    std::vector<float> tables;
    // Scratch: what of them reaches each of some boxes that are looked at together.
    static constexpr std::size_t kBoxes = 4;
    std::vector<std::int32_t> reaching;
    [[nodiscard]] std::int32_t* reaching_part(std::size_t box) {
        return reaching.data() + box * (reaching.size() / kBoxes);
    }

    // Notes where one is and makes room. The list must outlive the stay.
    void enter(SegmentIndices segments_there, const GridAxes& axes_there);
};

} // namespace ramus::field
