// Sampling a ConvolutionField: values on small grids and at lattice points. Everything is vectorised with run-time
// dispatch over the machine's instruction sets; within one instruction set a point's value has the same bits in
// whichever call it is computed, provided that the list holds every segment whose support contains the point, in
// ascending order.
#pragma once

#include "core/field/convolution_field.h"

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>

namespace ramus::field {

// Grid of 5 x 5 x 5 points, x fastest; values are padded to kGridStride entries.
inline constexpr int kGridSide = 5;
inline constexpr int kGridPoints = kGridSide * kGridSide * kGridSide;
inline constexpr int kGridStride = 128;

// Coordinates along the axes, padded to whole vectors: kGridSide of them count.
struct GridAxes {
    std::array<double, 8> x{}, y{}, z{}; // mm
};
// Returns one bit per point: is the value at or above the isovalue?
std::array<std::uint64_t, 2> sample_grid(const ConvolutionField& field, std::span<const std::uint32_t> list,
                                         const GridAxes& axes, std::span<float, kGridStride> values);

// Points given by indices into small tables of coordinates; at most kLatticeSide entries an axis.
inline constexpr int kLatticeSide = 17;
inline constexpr int kLatticeStride = 24;
struct LatticeAxes {
    std::array<double, kLatticeStride> x{}, y{}, z{}; // mm
};
struct LatticePoint {
    std::uint8_t i, j, k;
};
void sample_lattice(const ConvolutionField& field, std::span<const std::uint32_t> list, const LatticeAxes& axes,
                    std::span<const LatticePoint> points, std::span<float> values);

// Name of the instruction set in use, such as "AVX3".
const char* instruction_set();

} // namespace ramus::field
