// Axes: straight pieces of vessels' axes with linear radii, side by side in memory, for what is asked of many of them
// at one point. All in double precision and in the tree's coordinates, so that the answers have the same bits whoever
// asks.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <limits>
#include <optional>
#include <span>
#include <vector>

namespace ramus::field {

// Rows of numbers that are read by whole vectors.
template <std::size_t Rows> class NumberRows {
public:
    static constexpr std::size_t kWidestVector = 8;

    // The number of whole vectors' entries that holds so many.
    static constexpr std::size_t padded(std::size_t count) {
        return (count + kWidestVector - 1) / kWidestVector * kWidestVector;
    }
    // With room for so many, all of them 0.
    void resize(std::size_t most) {
        stride_ = padded(most);
        numbers_.assign(Rows * stride_, 0.0);
    }
    // With room for so many, and nothing in particular in it.
    void reserve(std::size_t most) {
        stride_ = padded(most);
        if (numbers_.size() < Rows * stride_) numbers_.resize(Rows * stride_);
    }
    [[nodiscard]] std::size_t stride() const { return stride_; } // from a row to the next one
    [[nodiscard]] double* row(std::size_t n) { return numbers_.data() + n * stride_; }
    [[nodiscard]] const double* row(std::size_t n) const { return numbers_.data() + n * stride_; }

private:
    std::size_t stride_ = 0;
    std::vector<double> numbers_;
};

// An axis: start (mm), unit direction, length (mm), radius at the start (mm) and its change per mm, and how far that
// goes on beyond the ends (FieldSegment::beyond).
enum AxisRow : std::uint8_t {
    kStartX,
    kStartY,
    kStartZ,
    kAlongX,
    kAlongY,
    kAlongZ,
    kAxisLength,
    kAxisRadius,
    kAxisSlope,
    kAxisBeyond,
    kAxisRows
};

struct Axes {
    NumberRows<kAxisRows> rows;
    NumberRows<1> marked; // not 0 where the axis is one of those that are told from the others
    std::size_t count = 0;

    void clear(std::size_t most) { rows.resize(most), marked.resize(most), count = 0; }
    void add(const glm::dvec3& start, const glm::dvec3& along, double length, double radius, double slope = 0.0,
             double beyond = 0.0);
    void mark_last() { marked.row(0)[count - 1] = 1.0; }
};

// Of a point, on each of some axes: the nearest place (mm), how far it is from the point (mm^2), the radius there (mm),
// and the distance in radii, squared.
// kFootNear: 1 where the axis is among those that are near, else 0; of all axes.
enum FootRow : std::uint8_t {
    kFootX,
    kFootY,
    kFootZ,
    kFootDistance2,
    kFootRadius,
    kFootRelative2,
    kFootNear,
    kFootRows
};
struct AxisFeet {
    // Some axes, by their places.
    struct Near {
        std::vector<std::uint32_t> places; // scratch: those that are near come first; written by whole vectors
        std::size_t count = 0;
        std::uint32_t nearest = 0; // in radii, the first of several; where there are any
        [[nodiscard]] std::span<const std::uint32_t> all() const { return std::span(places).first(count); } // ascending
    };
    NumberRows<kFootRows> rows;
    // Those nearer than so many radii; beyond an end from which radii go on shrinking, of the radius that it has there:
    // as far as the field reaches. Of these, the ones marked.
    Near near, marked;

    // With room for so many axes.
    void reserve(std::size_t most);
    [[nodiscard]] double of(std::uint32_t axis, FootRow row) const { return rows.row(row)[axis]; }
    [[nodiscard]] glm::dvec3 foot(std::uint32_t axis) const {
        return {of(axis, kFootX), of(axis, kFootY), of(axis, kFootZ)};
    }
};
// Overwrites `feet`, which have room for all axes: those of axes that are near, and of no others for sure.
void find_feet(const Axes& axes, const glm::dvec3& point, double radii, AxisFeet& feet);

// Of some axes, how they are to a vessel (vessel_field.h). What it is kept apart from: the closeness from which on the
// two count as together, 0 where it leaves out nothing; by how much less than that they have to be apart for the one to
// leave out the other wholly; and 1 where the two are apart at all. Of the others: 1 where the axis is of a piece in
// contact, so that walls may be drawn as if it were elsewhere, and 1 where they are.
enum RelationRow : std::uint8_t { kTogetherFrom, kFade, kIsApart, kInContact, kIsMoved, kRelationRows };
using AxisRelations = NumberRows<kRelationRows>;
// Of what a vessel is apart from and what is near, the least distance in radii, squared.
[[nodiscard]] double least_relative2(const AxisFeet& feet, const AxisRelations& relations, std::size_t count);
// Where some axis of the vessel is moved that is near: the nearest place to the point, in mm, on those of its axes that
// are near and in contact, as they count; `own`, which is one of these, before others that are as near.
[[nodiscard]] std::optional<glm::dvec3> find_counted_foot(const Axes& counted, const glm::dvec3& point,
                                                          const AxisFeet& feet, std::uint32_t own,
                                                          const AxisRelations& relations);
// How much of each axis' term one of them leaves out, 0 to 1.
void find_left_out(const AxisFeet& feet, std::uint32_t own, const AxisRelations& relations, std::size_t count,
                   double* left);

// What others press on: after an axis, how far its ends count as moved (core/tree/contacts/spread_axes.h) and the
// larger way of the two, mm, and the closeness from which on it and the vessel that it is an obstacle to count as
// together, and how near they come at least, mm.
enum ObstacleRow : std::uint8_t {
    kMoveStartX = kAxisRows,
    kMoveStartY,
    kMoveStartZ,
    kMoveEndX,
    kMoveEndY,
    kMoveEndZ,
    kMostMove,
    kApartFrom,
    kLeastDistance,
    kObstacleRows
};
using ObstacleRows = NumberRows<kObstacleRows>;
struct ObstacleRange {
    std::size_t first = 0, count = 0; // from the start of a vector on; what pads the last one has kApartFrom 0
};

// From an axis outward to a point.
struct WayOut {
    glm::dvec3 foot{0.0};      // where it begins, mm: on the axis as it counts
    glm::dvec3 direction{0.0}; // unit
    double length = 0.0;       // mm
    double radius = 0.0;       // of the vessel there, mm
    glm::dvec3 axis_foot{0.0}; // on the axis as it is, mm
};

// How far a point is from what lies behind an obstacle, seen from a vessel's axis: negative within.
struct Shadow {
    double spare = std::numeric_limits<double>::infinity(); // mm
    std::size_t obstacle = 0;                               // by its place in the rows; none where spare is infinite
};
// The nearest where that is nearer than `below`; else it may be any that is not, or none.
[[nodiscard]] Shadow nearest_shadow(const ObstacleRows& obstacles, const ObstacleRange& range, const WayOut& way,
                                    double below);
// The unit vector in which the spare room of one of them grows least, and how far the point is beyond where what lies
// behind the obstacle begins, mm; 0 before that.
struct ShadowSide {
    glm::dvec3 toward{0.0};
    double beyond = 0.0;
};
[[nodiscard]] ShadowSide side_of_shadow(const ObstacleRows& obstacles, std::size_t obstacle, const WayOut& way);

} // namespace ramus::field
