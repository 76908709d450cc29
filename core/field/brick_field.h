// BrickField: a field in one brick of the octree after another, with the memory that this takes. What a model of
// field.h computes there is compiled as a whole (vectorised, per kernel and instruction set): a call costs one
// indirection, for some hundred points or more.
//
// Before it stand the plain values that cross the seam between a field and the polygonizer.
#pragma once

#include "core/field/dominance.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace ramus::field {

// The points at which a field is sampled in one brick of the octree, and where their values go: a grid of 5 x 5 x 5,
// and single points of a finer lattice.

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
constexpr std::size_t points_in_group(std::size_t group) { return group + 1 < kGroups ? kGroupPoints : kEdgePoints; }
struct GridPlace {
    std::uint8_t x, y, z;
};
inline constexpr std::array<std::array<GridPlace, kGroupPoints>, kGroups> kGridPlaces = [] {
    std::array<std::array<GridPlace, kGroupPoints>, kGroups> places{};
    for (std::uint8_t b = 0; b < 4; ++b)
        for (std::uint8_t a = 0; a < 4; ++a) {
            const auto n = static_cast<std::size_t>(a + 4 * b);
            for (std::uint8_t z = 0; z < 4; ++z) places[z][n] = {a, b, z};
            places[4][n] = {4, a, b};
            places[5][n] = {a, 4, b};
            places[6][n] = {a, b, 4};
        }
    for (std::uint8_t a = 0; a < 4; ++a) {
        places[7][a] = {a, 4, 4};
        places[7][4U + a] = {4, a, 4};
        places[7][8U + a] = {4, 4, a};
    }
    for (std::size_t n = kEdgePoints - 1; n < kGroupPoints; ++n) places[7][n] = {4, 4, 4};
    return places;
}();
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
    friend bool operator==(const LatticePoint&, const LatticePoint&) = default;
};

// What goes into projecting points onto the surface, and what comes out: first guesses, and for each its point on the
// surface with normal, local radius and branch. Side by side in memory, padded to whole vectors.

inline constexpr std::size_t kProjectionPadding = 32; // points are read and written by whole vectors, two at most
inline constexpr int kProjectionSteps = 2;            // at most

// First guesses of points on the surface. Positions are relative to the brick's corner, in mm; each point
// stays within `reach` of its centre along every axis. The arrays are longer than size(): they are kept from use to use
// and padded to whole vectors.
struct Projection {
    std::vector<float> x, y, z;
    std::vector<float> cx, cy, cz, reach;

    [[nodiscard]] std::size_t size() const { return size_; }
    void clear() { size_ = 0; }
    void add(glm::vec3 guess, glm::vec3 centre, float half_extent) {
        if (size_ == x.size()) grow(2 * size_ + 64);
        set(size_++, guess, centre, half_extent);
    }
    void set(std::size_t n, glm::vec3 guess, glm::vec3 centre, float half_extent) {
        x[n] = guess.x, y[n] = guess.y, z[n] = guess.z;
        cx[n] = centre.x, cy[n] = centre.y, cz[n] = centre.z;
        reach[n] = half_extent;
    }
    // Adds `count` points to be filled in, and returns the first. The arrays go on for a whole vector behind the last.
    std::size_t extend(std::size_t count) {
        constexpr std::size_t kWidestVector = 16;
        const std::size_t first = size_;
        size_ += count;
        if (size_ + kWidestVector > x.size()) grow(2 * size_ + 64);
        return first;
    }
    void grow(std::size_t capacity);
    // Repeats the last point behind the end, kProjectionPadding times. Not of none.
    void pad();

private:
    std::size_t size_ = 0;
};

// Where the points go, arrays that go on for kProjectionPadding more than there are.
struct SurfacePoints {
    glm::vec3* positions;   // mm
    glm::vec3* normals;     // unit length, outward
    float* radii;           // local radius, mm: of the strongest segment there
    std::int32_t* branches; // that contribute most
    Dominance* dominance;
};

// The eight children of a cube, and bounds of a field over each: what decides where the surface can be.

// Numbered by bits: 1 = upper x, 2 = upper y, 4 = upper z.
inline constexpr int kChildren = 8;

// Eight cubes of edge `side` around `middle`: mm, relative to the middle of the field's extent.
struct ChildCubes {
    glm::vec3 middle{0.0F};
    float side = 0.0F;
};

struct ChildCentres {
    alignas(32) std::array<float, kChildren> x, y, z;
    explicit ChildCentres(const ChildCubes& cubes) {
        for (std::size_t c = 0; c < kChildren; ++c) {
            x[c] = cubes.middle.x + ((c & 1) != 0 ? 0.5F : -0.5F) * cubes.side;
            y[c] = cubes.middle.y + ((c & 2) != 0 ? 0.5F : -0.5F) * cubes.side;
            z[c] = cubes.middle.z + ((c & 4) != 0 ? 0.5F : -0.5F) * cubes.side;
        }
    }
};

// Where the field may reach the isovalue, the upper bound says only that.
struct ChildBounds {
    std::array<float, kChildren> lower{}, upper{};
};

using SegmentIndices = std::span<const std::uint32_t>; // ascending

class Separation; // core/field/separation.h
struct CutEnd;    // core/field/cut_ends.h

// Counts returned: kernels evaluated, one for each segment and point.
class BrickField {
public:
    virtual ~BrickField() = default;
    // Begins a brick: the segments that reach it, which must outlive the stay, and the coordinates of its grid points.
    virtual void enter(SegmentIndices list, const GridAxes& axes) = 0;
    // Values at the groups of grid points that have their bits set.
    virtual std::uint64_t sample_groups(unsigned groups, GridGroups& samples) = 0;
    // Values at points of a finer lattice with the same corner in the same box.
    virtual std::uint64_t sample_lattice(const LatticeAxes& lattice, std::span<const LatticePoint> points,
                                         std::span<float> values) = 0;
    // Moves points onto the surface. Each stays within its reach.
    virtual std::uint64_t project(Projection& guesses, const SurfacePoints& to) = 0;
    // From values to numbers that are nearly linear in the distance from the surface: 0 or more exactly where the value
    // is at or above the isovalue, less outside.
    virtual void find_depths(const GridValues& values, GridValues& depths) const = 0;
    // The share of the way along an edge, from a value on one side of the isovalue to one on the other, at which the
    // surface crosses it.
    [[nodiscard]] virtual float crossing(float from, float to) const = 0;

    // How vessels are kept apart in this brick; null: they are not, and the field is smooth here. Until the next
    // enter().
    [[nodiscard]] virtual Separation* separation() { return nullptr; }

    // Ends that surfaces are flat at. They outlive the field.
    void set_cut_ends(const std::vector<CutEnd>& ends) { cut_ends_ = &ends; }
    // The last step for points on the surface: moves those that are beyond a cut end.
    void flatten(const SurfacePoints& points, std::size_t count) const;

private:
    const std::vector<CutEnd>* cut_ends_ = nullptr;
};

} // namespace ramus::field
