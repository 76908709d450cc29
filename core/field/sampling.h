// Sampling a ConvolutionField: values on small grids and at lattice points. Everything is vectorised with run-time
// dispatch over the machine's instruction sets; within one instruction set a point's value has the same bits in
// whichever call it is computed, provided that the list holds every segment whose support contains the point, in
// ascending order.
#pragma once

#include "core/field/convolution_field.h"
#include "core/field/local_segments.h"

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>

namespace ramus::field {

// The points of a grid in groups of 16, each compact, so that few segments reach it. Groups 0 to 3: the layers
// z = 0 .. 3 of the points below the upper sides, x + 4 y. Groups 4 to 6: the upper sides x = 4 (y + 4 z), y = 4
// (x + 4 z) and z = 4 (x + 4 y). Group 7: the upper edges along x, y and z, 4 points each, then the corner.
inline constexpr std::size_t kGroups = 8;
inline constexpr std::size_t kGroupPoints = 16;
inline constexpr std::size_t kEdgePoints = 13; // of the last group that count
inline constexpr unsigned kOwnGroups = 0x0F;
struct GridGroups {
    alignas(64) std::array<std::array<float, kGroupPoints>, kGroups> value;
    std::array<std::uint16_t, kGroups> inside; // one bit per point: is the value at or above the isovalue?
};
// Fills in the groups that have their bits set. Returns the number of kernels evaluated, one per segment and point.
// kAllSegments evaluates every kernel everywhere: the same values, for measuring what choosing saves.
enum class Choice { kReaching, kAllSegments };
std::uint64_t sample_groups(const LocalSegments& local, unsigned groups, GridGroups& samples,
                            Choice choice = Choice::kReaching);

// Points given by indices into small tables of coordinates; at most kLatticeSide entries an axis.
inline constexpr int kLatticeSide = 17;
inline constexpr int kLatticeStride = 24;
struct LatticeAxes {
    std::array<double, kLatticeStride> x{}, y{}, z{}; // mm
};
struct LatticePoint {
    std::uint8_t i, j, k;
};
// The corner of `axes` is that of `local`, and its box the same. Returns the number of kernels evaluated.
std::uint64_t sample_lattice(const LocalSegments& local, const LatticeAxes& axes, std::span<const LatticePoint> points,
                             std::span<float> values);

// Name of the instruction set in use, such as "AVX3".
const char* instruction_set();

} // namespace ramus::field
