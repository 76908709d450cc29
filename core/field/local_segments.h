// LocalSegments: the segments that matter to one small cube of space, side by side in memory and in single precision as
// seen from the cube's corner. Gathered once for a brick, then used by all that samples the field there.
#pragma once

#include "core/field/convolution_field.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace ramus::field {

// Grid of 5 x 5 x 5 points.
inline constexpr int kGridSide = 5;
inline constexpr int kGridPoints = kGridSide * kGridSide * kGridSide;

// Its coordinates along the axes, padded to whole vectors: kGridSide of them count.
struct GridAxes {
    std::array<double, 8> x{}, y{}, z{}; // mm
    [[nodiscard]] glm::dvec3 corner() const { return {x[0], y[0], z[0]}; }
};

struct LocalSegments {
    const ConvolutionField* field = nullptr;
    GridAxes axes;
    std::size_t count = 0;
    std::span<const std::uint32_t> list; // indices in the field, ascending

    // By segment. The arrays go on for at least a vector's width.
    std::vector<float> x, y, z; // start relative to the corner, mm
    std::vector<float> ux, uy, uz, length, radius, slope;
    std::vector<std::int32_t> branch;
    // Coordinates of the grid seen from the segment's start: 8 along x, 8 along y, 8 along z. Rounded once from double
    // precision: the same point of space gives the same float whatever the grid it is taken from.
    static constexpr std::size_t kTableStride = 32;
    std::vector<float> tables;
    // Scratch: what of them reaches each of some boxes that are looked at together.
    static constexpr std::size_t kBoxes = 4;
    mutable std::vector<std::int32_t> reaching;
    [[nodiscard]] std::int32_t* reaching_part(std::size_t box) const {
        return reaching.data() + box * (reaching.size() / kBoxes);
    }
};

// `list` must outlive `local`.
void gather_segments(const ConvolutionField& field, std::span<const std::uint32_t> list, const GridAxes& axes,
                     LocalSegments& local);

} // namespace ramus::field
