// Axes: geometric queries of one point against many straight vessel axes at once: nearest points, distances, weights of
// partners, and shadows of obstacles.
//
// An axis is a line segment with a linear radius. Axes are stored as a structure of arrays and processed with SIMD.
// Positions are in mm, in the coordinates of the tree, in double precision. The result for an axis does not depend on
// the other axes in the list, so two bricks that share a point compute the same bits.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <limits>
#include <optional>
#include <span>
#include <vector>

namespace ramus::field {

// A matrix of doubles in rows. Rows are padded to whole SIMD vectors.
template <std::size_t Rows> class NumberRows {
public:
    static constexpr std::size_t kWidestVector = 8;

    // `count`, rounded up to whole vectors.
    static constexpr std::size_t padded(std::size_t count) {
        return (count + kWidestVector - 1) / kWidestVector * kWidestVector;
    }
    // Sets the number of columns, and every number to 0.
    void resize(std::size_t most) {
        stride_ = padded(most);
        numbers_.assign(Rows * stride_, 0.0);
    }
    // Sets the number of columns. The content is unspecified.
    void reserve(std::size_t most) {
        stride_ = padded(most);
        if (numbers_.size() < Rows * stride_) numbers_.resize(Rows * stride_);
    }
    [[nodiscard]] std::size_t stride() const { return stride_; } // numbers from one row to the next
    [[nodiscard]] double* row(std::size_t n) { return numbers_.data() + n * stride_; }
    [[nodiscard]] const double* row(std::size_t n) const { return numbers_.data() + n * stride_; }

private:
    std::size_t stride_ = 0;
    std::vector<double> numbers_;
};

// The rows of an axis: start (mm), unit direction, length (mm), radius at the start (mm), change of the radius per mm,
// and how far the radius keeps changing beyond the ends (FieldSegment::beyond).
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
    NumberRows<1> marked; // 1 where the axis was marked with mark_last(): find_feet() lists marked axes separately
    std::size_t count = 0;

    void clear(std::size_t most) { rows.resize(most), marked.resize(most), count = 0; }
    void add(const glm::dvec3& start, const glm::dvec3& along, double length, double radius, double slope = 0.0,
             double beyond = 0.0);
    void mark_last() { marked.row(0)[count - 1] = 1.0; }
};

// The rows of a foot, the point of an axis that is nearest to a query point: its position (mm), its squared distance
// from the query point (mm^2), the radius there (mm), and the squared distance in radii.
// kFootNear: 1 where the axis is near, else 0. Only this row is valid for axes that are not near.
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
    // A list of axes, by index.
    struct Near {
        std::vector<std::uint32_t> places; // only the first `count` are valid; written by whole vectors
        std::size_t count = 0;
        std::uint32_t nearest = 0; // the least distance in radii; the lowest index of several. Valid if count > 0
        [[nodiscard]] std::span<const std::uint32_t> all() const { return std::span(places).first(count); } // ascending
    };
    NumberRows<kFootRows> rows;
    // `near`: the axes that are nearer than a number of radii. Beyond an end where the radius keeps shrinking, the
    // shrunken radius counts, as in the field. `marked`: the marked axes of `near`.
    Near near, marked;

    // Allocates room for `most` axes.
    void reserve(std::size_t most);
    [[nodiscard]] double of(std::uint32_t axis, FootRow row) const { return rows.row(row)[axis]; }
    [[nodiscard]] glm::dvec3 foot(std::uint32_t axis) const {
        return {of(axis, kFootX), of(axis, kFootY), of(axis, kFootZ)};
    }
};
// Finds the axes that are nearer to `point` (mm) than `radii` radii, and their feet. `feet` must have room for all
// axes.
void find_feet(const Axes& axes, const glm::dvec3& point, double radii, AxisFeet& feet);

// The relation of each axis to the current vessel (vessel_field.h). For an axis that is kept apart from the vessel:
// - kTogetherFrom: the closeness from which the two count as together again; 0 for a near miss, which is not left out.
// - kFade: 1 / the range of closenesses below kTogetherFrom over which the weight of the axis falls from 1 to 0.
// - kIsApart: 1.
// For any other axis:
// - kInContact: 1 where the piece of the axis has partners, in this brick or elsewhere.
// - kIsMoved: 1 where the axis counts as moved when walls are drawn (core/tree/contacts/spread_axes.h).
enum RelationRow : std::uint8_t { kTogetherFrom, kFade, kIsApart, kInContact, kIsMoved, kRelationRows };
using AxisRelations = NumberRows<kRelationRows>;
// The least squared distance in radii over the near axes that are apart from the vessel; infinity if there are none.
[[nodiscard]] double least_relative2(const AxisFeet& feet, const AxisRelations& relations, std::size_t count);
// The point (mm) nearest to `point` on the vessel's near axes that are in contact, at their moved positions `counted`.
// Prefers the axis `own` where several are equally near. Returns nothing where none of these axes is moved.
[[nodiscard]] std::optional<glm::dvec3> find_counted_foot(const Axes& counted, const glm::dvec3& point,
                                                          const AxisFeet& feet, std::uint32_t own,
                                                          const AxisRelations& relations);
// Writes to `left` the share of each axis' term, 0 to 1, that the view of the vessel of axis `own` leaves out.
void find_left_out(const AxisFeet& feet, std::uint32_t own, const AxisRelations& relations, std::size_t count,
                   double* left);

// The rows of an obstacle, a piece of vessel that casts a shadow on a partner. After the rows of an axis: how far its
// ends count as moved (core/tree/contacts/spread_axes.h), the longer one of the two moves, the closeness from which
// obstacle and vessel count as together, and a lower bound of the distance of the two axes. Lengths are in mm.
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
    std::size_t first = 0, count = 0; // `first` begins a SIMD vector; padding entries have kApartFrom 0
};

// The straight way from the axis of a vessel outward to a point.
struct WayOut {
    glm::dvec3 foot{0.0};      // where the way begins, mm: on the moved axis
    glm::dvec3 direction{0.0}; // unit
    double length = 0.0;       // mm
    double radius = 0.0;       // of the vessel at axis_foot, mm
    glm::dvec3 axis_foot{0.0}; // on the real axis, mm
};

// The distance of a point from the shadow of an obstacle: the region behind the obstacle, seen from a vessel's axis.
struct Shadow {
    double spare = std::numeric_limits<double>::infinity(); // mm, to first order; negative within the shadow
    std::size_t obstacle = 0;                               // column of ObstacleRows; none where spare is infinite
};
// The nearest shadow at the end of the way, if its distance is less than `below` mm. Otherwise the result has some
// distance of at least `below`.
[[nodiscard]] Shadow nearest_shadow(const ObstacleRows& obstacles, const ObstacleRange& range, const WayOut& way,
                                    double below);
// The unit direction toward the shadow of one obstacle, along which Shadow::spare decreases fastest, and how far (mm)
// the point lies beyond the beginning of the shadow along the way; 0 before the beginning.
struct ShadowSide {
    glm::dvec3 toward{0.0};
    double beyond = 0.0;
};
[[nodiscard]] ShadowSide side_of_shadow(const ObstacleRows& obstacles, std::size_t obstacle, const WayOut& way);

} // namespace ramus::field
