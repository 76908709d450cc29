// LocalSegments: the segments that reach a brick, as a structure of arrays in single precision, relative to the brick's
// corner. Filled once for each brick, and used by all functions that sample the field there.
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
    const FieldSegment* segments = nullptr; // all segments of the field
    GridAxes axes;
    std::size_t count = 0;
    SegmentIndices list;

    // By segment of the list. The arrays extend at least a vector's width beyond `count`.
    std::vector<float> x, y, z; // start relative to the corner, mm
    std::vector<float> ux, uy, uz, length, radius, slope, beyond;
    std::vector<std::int32_t> branch;
    std::vector<float> excess, excess_slope; // as in FieldSegment
    bool has_excess = false;                 // whether any segment has an excess
    // Coordinates of the grid relative to the segment's start: 8 along x, 8 along y, 8 along z. Rounded once from
    // double precision, so that a point has the same coordinates in every grid that contains it.
    static constexpr std::size_t kTableStride = 32;
    std::vector<float> tables;
    // Scratch: the segments that reach each of up to kBoxes boxes.
    static constexpr std::size_t kBoxes = 4;
    std::vector<std::int32_t> reaching;
    [[nodiscard]] std::int32_t* reaching_part(std::size_t box) {
        return reaching.data() + box * (reaching.size() / kBoxes);
    }

    // Begins a brick: sets the list and the axes, and allocates the arrays. The list must stay valid until the next
    // call.
    void enter(SegmentIndices segments_there, const GridAxes& axes_there);
};

} // namespace ramus::field
