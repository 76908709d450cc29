// The points at which a field is sampled in one brick of the octree, and where their values go: a grid of 5 x 5 x 5,
// and single points of a finer lattice.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>

namespace ramus::field {

inline constexpr int kGridSide = 5;
inline constexpr int kGridPoints = kGridSide * kGridSide * kGridSide;

// Coordinates along the axes, padded to whole vectors: kGridSide of them count.
struct GridAxes {
    std::array<double, 8> x{}, y{}, z{}; // mm
    [[nodiscard]] glm::dvec3 corner() const { return {x[0], y[0], z[0]}; }
};

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

// One number for each grid point, x + 5 y + 25 z, padded to whole vectors.
inline constexpr std::size_t kGridStride = 128;
struct alignas(64) GridValues : std::array<float, kGridStride> {};

// Points given by indices into small tables of coordinates; at most kLatticeSide entries an axis.
inline constexpr int kLatticeSide = 17;
inline constexpr int kLatticeStride = 24;
struct LatticeAxes {
    std::array<double, kLatticeStride> x{}, y{}, z{}; // mm
};
struct LatticePoint {
    std::uint8_t i, j, k;
};

} // namespace ramus::field
