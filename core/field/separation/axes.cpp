#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/field/separation/axes.cpp"
// clang-format off: foreach_target compiles this file once per instruction set and must come first.
#include <hwy/foreach_target.h>
// clang-format on
#include "core/field/separation/axes.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace ramus::field::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Doubles = hn::CappedTag<double, 8>;
using Real = hn::Vec<Doubles>;

struct Vector {
    Real x, y, z;
};
HWY_INLINE Vector set(const glm::dvec3& v) {
    const Doubles d;
    return {hn::Set(d, v.x), hn::Set(d, v.y), hn::Set(d, v.z)};
}
template <class Rows> HWY_INLINE Vector load(const Rows& rows, std::size_t first_row, std::size_t n) {
    const Doubles d;
    return {hn::LoadU(d, rows.row(first_row) + n), hn::LoadU(d, rows.row(first_row + 1) + n),
            hn::LoadU(d, rows.row(first_row + 2) + n)};
}
HWY_INLINE Vector minus(const Vector& a, const Vector& b) {
    return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
}
// a + s b
HWY_INLINE Vector along(const Vector& a, Real s, const Vector& b) {
    return {hn::MulAdd(s, b.x, a.x), hn::MulAdd(s, b.y, a.y), hn::MulAdd(s, b.z, a.z)};
}
HWY_INLINE Real dot(const Vector& a, const Vector& b) {
    return hn::MulAdd(a.z, b.z, hn::MulAdd(a.y, b.y, hn::Mul(a.x, b.x)));
}
HWY_INLINE Real limited(Real x, Real low, Real high) { return hn::Min(hn::Max(x, low), high); }

// The least number, and the index of its axis; the lowest index of several.
struct LeastOfAxes {
    double number;
    std::uint32_t axis;
};
// The least number so far in each lane, and its index.
struct Least {
    Real number, place;

    HWY_INLINE void see(hn::Mask<Doubles> which, Real numbers, Real places) {
        const auto less = hn::And(which, hn::Lt(numbers, number));
        number = hn::IfThenElse(less, numbers, number);
        place = hn::IfThenElse(less, places, place);
    }
    HWY_INLINE LeastOfAxes of_all_lanes() const {
        const Doubles d;
        const Real least = hn::MinOfLanes(d, number);
        const Real far = hn::Set(d, std::numeric_limits<double>::infinity());
        const Real places = hn::IfThenElse(hn::Eq(number, least), place, far);
        return {hn::GetLane(least), static_cast<std::uint32_t>(hn::GetLane(hn::MinOfLanes(d, places)))};
    }
};

using Numbers = hn::Rebind<std::uint32_t, Doubles>;

// Appends the selected lanes of `places`. Writes a whole vector at `next`.
HWY_INLINE std::uint32_t* put_places(hn::Mask<Doubles> which, hn::Vec<Numbers> places, std::uint32_t* next) {
    const Numbers d;
    HWY_ALIGN std::uint8_t bits[8] = {};
    hn::StoreMaskBits(Doubles(), which, bits);
    hn::StoreU(hn::Compress(places, hn::LoadMaskBits(d, bits)), d, next);
    return next + std::popcount(bits[0]);
}

// A copy of the pointer and the stride of NumberRows. The compiler cannot prove that vector stores leave the original
// members unchanged, so it would load them again after each store.
template <class Number> struct RowsAt {
    Number* first;
    std::size_t stride;
    [[nodiscard]] HWY_INLINE Number* row(std::size_t n) const { return first + n * stride; }
};
template <std::size_t Rows> RowsAt<double> rows_at(NumberRows<Rows>& rows) { return {rows.row(0), rows.stride()}; }
template <std::size_t Rows> RowsAt<const double> rows_at(const NumberRows<Rows>& rows) {
    return {rows.row(0), rows.stride()};
}

// Which axes are nearer than sqrt(reach2) radii, where the radius shrinks beyond an end (radius_along() of
// segment_foot-inl.h). A linear continuation bounds that radius from below, which decides most cases without a
// division.
HWY_INLINE hn::Mask<Doubles> is_near(Real distance2, Real reach2, Real radius, Real change, Real size, Real beyond) {
    const Doubles d;
    const auto within = [&](Real r) { return hn::Lt(distance2, hn::Mul(reach2, hn::Mul(r, r))); };
    const auto perhaps = within(radius);
    const Real least = hn::Add(radius, change);
    const auto surely = within(hn::Min(radius, hn::Max(least, hn::Zero(d))));
    const auto surely_not = hn::And(hn::Not(perhaps), hn::Ge(least, hn::Neg(radius)));
    if (hn::AllTrue(d, hn::Or(surely, surely_not))) return perhaps;
    const Real room = hn::MulAdd(hn::Max(beyond, hn::Set(d, 1e-9)), radius, size);
    const Real carried = hn::Sub(hn::Set(d, 1.0), hn::Div(size, hn::Max(room, hn::Set(d, 1e-300))));
    return within(hn::Min(radius, hn::MulAdd(change, carried, radius)));
}

// The points nearest to a query point on one vector of axes.
struct Places {
    Real along_axis, t; // mm from the start, before and after clamping to the segment
    Vector off;         // from the nearest point to the query point
    Real distance2;
};
HWY_INLINE Places places_on(const RowsAt<const double>& rows, std::size_t n, const Vector& p) {
    const Doubles d;
    const Vector u = load(rows, kAlongX, n);
    const Vector from = minus(p, load(rows, kStartX, n));
    const Real along_axis = dot(from, u);
    const Real t = limited(along_axis, hn::Zero(d), hn::LoadU(d, rows.row(kAxisLength) + n));
    Places places{along_axis, t, along(from, hn::Neg(t), u), hn::Zero(d)};
    places.distance2 = dot(places.off, places.off);
    return places;
}
HWY_INLINE void put(const Places& places, const Vector& p, const RowsAt<double>& to, std::size_t n) {
    const Doubles d;
    const Vector foot = minus(p, places.off);
    hn::StoreU(foot.x, d, to.row(kFootX) + n);
    hn::StoreU(foot.y, d, to.row(kFootY) + n);
    hn::StoreU(foot.z, d, to.row(kFootZ) + n);
    hn::StoreU(places.distance2, d, to.row(kFootDistance2) + n);
}

void find_feet(const Axes& axes, const glm::dvec3& point, double radii, AxisFeet& feet) {
    const Doubles d;
    const Vector p = set(point);
    const auto rows = rows_at(axes.rows);
    const auto to = rows_at(feet.rows);
    const double* const marks = axes.marked.row(0);
    const Real reach2 = hn::Set(d, radii * radii), zero = hn::Zero(d);
    std::uint32_t* next = feet.near.places.data();
    std::uint32_t* next_marked = feet.marked.places.data();
    const Real far = hn::Set(d, std::numeric_limits<double>::infinity());
    Least least_near{far, zero}, least_marked{far, zero};
    // Incremented: building the indices anew for each vector would pass them through memory, which takes far longer.
    auto numbers = hn::Iota(Numbers(), 0);
    const auto lanes = hn::Set(Numbers(), static_cast<std::uint32_t>(hn::Lanes(d)));
    for (std::size_t n = 0; n < axes.count; n += hn::Lanes(d), numbers = hn::Add(numbers, lanes)) {
        const Places there = places_on(rows, n, p);
        const Real distance2 = there.distance2;
        const Real slope = hn::LoadU(d, rows.row(kAxisSlope) + n);
        const Real radius = hn::MulAdd(slope, there.t, hn::LoadU(d, rows.row(kAxisRadius) + n));
        hn::StoreU(zero, d, to.row(kFootNear) + n);
        if (hn::AllFalse(d, hn::Lt(distance2, hn::Mul(reach2, hn::Mul(radius, radius))))) continue;
        const Real relative2 = hn::Div(distance2, hn::Mul(radius, radius));
        put(there, p, to, n);
        hn::StoreU(radius, d, to.row(kFootRadius) + n);
        hn::StoreU(relative2, d, to.row(kFootRelative2) + n);
        // Padding axes have radius 0, so nothing is near them.
        const Real excess = hn::Sub(there.along_axis, there.t);
        const auto near = is_near(distance2, reach2, radius, hn::Mul(slope, excess), hn::Abs(excess),
                                  hn::LoadU(d, rows.row(kAxisBeyond) + n));
        if (hn::AllFalse(d, near)) continue;
        hn::StoreU(hn::IfThenElseZero(near, hn::Set(d, 1.0)), d, to.row(kFootNear) + n);
        const auto marked = hn::And(near, hn::Gt(hn::LoadU(d, marks + n), zero));
        const Real places = hn::Iota(d, static_cast<double>(n));
        least_near.see(near, relative2, places);
        next = put_places(near, numbers, next);
        if (hn::AllFalse(d, marked)) continue;
        least_marked.see(marked, relative2, places);
        next_marked = put_places(marked, numbers, next_marked);
    }
    feet.near.count = static_cast<std::size_t>(next - feet.near.places.data());
    feet.marked.count = static_cast<std::size_t>(next_marked - feet.marked.places.data());
    feet.near.nearest = least_near.of_all_lanes().axis;
    feet.marked.nearest = least_marked.of_all_lanes().axis;
}

void find_left_out(const AxisFeet& feet, std::uint32_t own, const AxisRelations& relations, std::size_t count,
                   double* left) {
    const Doubles d;
    const Real zero = hn::Zero(d), one = hn::Set(d, 1.0), two = hn::Set(d, 2.0), three = hn::Set(d, 3.0);
    const Vector foot = set(feet.foot(own));
    const Real radius = hn::Set(d, feet.of(own, kFootRadius));
    for (std::size_t n = 0; n < count; n += hn::Lanes(d)) {
        const Real from = hn::LoadU(d, relations.row(kTogetherFrom) + n);
        hn::StoreU(zero, d, left + n);
        if (hn::AllFalse(d, hn::Gt(from, zero))) continue;
        const Vector between = minus(load(feet.rows, kFootX, n), foot);
        const Real radii = hn::Add(hn::LoadU(d, feet.rows.row(kFootRadius) + n), radius);
        const Real closeness = hn::Div(hn::Sqrt(dot(between, between)), radii);
        const Real x = limited(hn::Mul(hn::Sub(from, closeness), hn::LoadU(d, relations.row(kFade) + n)), zero, one);
        hn::StoreU(hn::Mul(hn::Mul(x, x), hn::NegMulAdd(two, x, three)), d, left + n);
    }
}

HWY_INLINE hn::Mask<Doubles> is_set(const double* row, std::size_t n) {
    const Doubles d;
    return hn::Gt(hn::LoadU(d, row + n), hn::Zero(d));
}

double least_relative2(const AxisFeet& feet, const AxisRelations& relations, std::size_t count) {
    const Doubles d;
    const double* const near = feet.rows.row(kFootNear);
    const double* const is_apart = relations.row(kIsApart);
    Real least = hn::Set(d, std::numeric_limits<double>::infinity());
    for (std::size_t n = 0; n < count; n += hn::Lanes(d)) {
        const auto which = hn::And(is_set(near, n), is_set(is_apart, n));
        least = hn::IfThenElse(which, hn::Min(least, hn::LoadU(d, feet.rows.row(kFootRelative2) + n)), least);
    }
    return hn::GetLane(hn::MinOfLanes(d, least));
}

std::optional<glm::dvec3> find_counted_foot(const Axes& counted, const glm::dvec3& point, const AxisFeet& feet,
                                            std::uint32_t own, const AxisRelations& relations) {
    const Doubles d;
    constexpr std::size_t kMostLanes = NumberRows<1>::kWidestVector;
    const std::size_t lanes = hn::Lanes(d);
    const Vector p = set(point);
    const auto rows = rows_at(counted.rows);
    const double* const near = feet.rows.row(kFootNear);
    Least least{hn::Set(d, std::numeric_limits<double>::infinity()), hn::Zero(d)};
    bool any_moved = false;
    for (std::size_t n = 0; n < counted.count; n += lanes) {
        const auto is_near = is_set(near, n);
        const auto counts = hn::And(is_near, is_set(relations.row(kInContact), n));
        if (hn::AllFalse(d, counts)) continue;
        any_moved = any_moved || !hn::AllFalse(d, hn::And(is_near, is_set(relations.row(kIsMoved), n)));
        least.see(counts, places_on(rows, n, p).distance2, hn::Iota(d, static_cast<double>(n)));
    }
    if (!any_moved) return std::nullopt;
    const LeastOfAxes nearest = least.of_all_lanes();
    // Reads the lane of one axis.
    const auto number_at = [&](Real numbers_there, std::size_t place) {
        HWY_ALIGN std::array<double, kMostLanes> there;
        hn::Store(numbers_there, d, there.data());
        return there[place % lanes];
    };
    const auto vector_of = [&](std::size_t place) { return place / lanes * lanes; };
    const double own_distance2 = number_at(places_on(rows, vector_of(own), p).distance2, own);
    const std::size_t chosen = nearest.number < own_distance2 ? nearest.axis : own;
    const Vector foot = minus(p, places_on(rows, vector_of(chosen), p).off);
    return glm::dvec3(number_at(foot.x, chosen), number_at(foot.y, chosen), number_at(foot.z, chosen));
}

// An upper bound of the distance from the axis' foot to an obstacle whose shadow is nearer than `below`, without the
// moves of its ends. A shadow begins beyond the middle of the way to its obstacle. Has a margin for rounding.
double reach_of_shadows(const WayOut& way, double below) {
    return std::max(2.0 * (way.length + below) + 1e-6 * way.length, 0.0) + glm::length(way.foot - way.axis_foot);
}

Shadow nearest_shadow(const ObstacleRows& obstacles, const ObstacleRange& range, const WayOut& way, double below) {
    const Doubles d;
    const auto rows = rows_at(obstacles);
    const Real zero = hn::Zero(d), far = hn::Set(d, std::numeric_limits<double>::infinity());
    const Vector foot = set(way.foot), w = set(way.direction), axis_foot = set(way.axis_foot);
    const Real way_length = hn::Set(d, way.length), own_radius = hn::Set(d, way.radius);
    const Real beyond = hn::Set(d, reach_of_shadows(way, below));
    Least nearest{far, zero};
    for (std::size_t n = range.first; n < range.first + range.count; n += hn::Lanes(d)) {
        const Vector start = load(rows, kStartX, n), u = load(rows, kAlongX, n);
        const Real length = hn::LoadU(d, rows.row(kAxisLength) + n);
        const Real start_radius = hn::LoadU(d, rows.row(kAxisRadius) + n);
        const Real slope = hn::LoadU(d, rows.row(kAxisSlope) + n);
        // Skip obstacles that count as together with the vessel at this foot.
        const Vector between_axes = minus(axis_foot, start);
        const Real t = limited(dot(between_axes, u), zero, length);
        const Vector gap = along(between_axes, hn::Neg(t), u);
        const Real most =
            hn::Mul(hn::LoadU(d, rows.row(kApartFrom) + n), hn::Add(own_radius, hn::MulAdd(slope, t, start_radius)));
        const Real gap2 = dot(gap, gap);
        const auto is_apart = hn::Lt(gap2, hn::Mul(most, most));
        const Real concerns = hn::Add(beyond, hn::LoadU(d, rows.row(kMostMove) + n));
        if (hn::AllFalse(d, hn::And(is_apart, hn::Lt(gap2, hn::Mul(concerns, concerns))))) continue;
        // Where the way is nearest to the obstacle's axis, the distance there, and half of its length within the
        // obstacle.
        const Vector across = minus(start, foot);
        const Real cosine = dot(w, u);
        const Real sine2 = hn::Max(hn::NegMulAdd(cosine, cosine, hn::Set(d, 1.0)), hn::Set(d, 1e-12));
        Real at = hn::Div(hn::NegMulAdd(cosine, dot(across, u), dot(across, w)), sine2);
        const auto beside_way = [&](Real place) { return dot(minus(along(foot, place, w), start), u); };
        const Real beside_line = beside_way(at);
        Real beside = limited(beside_line, zero, length);
        const auto is_within = hn::And(hn::Gt(beside_line, zero), hn::Lt(beside_line, length));
        at = hn::IfThenElse(is_within, at, dot(along(across, beside, u), w));
        beside = hn::IfThenElse(is_within, beside, limited(beside_way(at), zero, length));
        const Vector axis = along(start, beside, u);
        const Vector off = minus(along(foot, at, w), axis);
        const Real off2 = dot(off, off);
        const Real radius = hn::MulAdd(slope, beside, start_radius);
        const Real lateral =
            hn::Mul(hn::Sub(hn::Sqrt(off2), radius), hn::Min(hn::Div(way_length, at), hn::Set(d, 1.0)));
        const Real half_chord = hn::Sqrt(hn::Max(hn::Sub(hn::Mul(radius, radius), off2), zero));
        // `middle`: beyond this length, points of the way are nearer to the obstacle's moved axis than to the foot.
        const Real share = hn::Div(beside, hn::Max(length, hn::Set(d, 1e-300)));
        const Vector move_start = load(rows, kMoveStartX, n);
        const Vector move = along(move_start, share, minus(load(rows, kMoveEndX, n), move_start));
        const Vector to_obstacle = along(minus(axis, foot), hn::Set(d, 1.0), move);
        const Real ahead = dot(to_obstacle, w);
        const Real middle = hn::IfThenElse(
            hn::Gt(ahead, zero), hn::Div(hn::Mul(hn::Set(d, 0.5), dot(to_obstacle, to_obstacle)), ahead), far);
        const Real front = hn::Sub(hn::Max(at, middle), way_length);
        const auto is_passed = hn::And(hn::Ge(middle, hn::Add(at, half_chord)), hn::Lt(lateral, zero));
        auto counts = hn::And(is_apart, hn::And(hn::Gt(length, zero), hn::Gt(at, zero)));
        counts = hn::And(counts, hn::And(hn::Le(at, hn::Add(way_length, own_radius)), hn::Not(is_passed)));
        if (hn::AllFalse(d, counts)) continue;
        const auto is_front = hn::Or(hn::Ge(front, lateral), hn::Not(hn::Gt(off2, zero)));
        nearest.see(counts, hn::IfThenElse(is_front, front, lateral), hn::Iota(d, static_cast<double>(n)));
    }
    const LeastOfAxes least = nearest.of_all_lanes();
    return {least.number, least.axis};
}

} // namespace ramus::field::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace ramus::field {

HWY_EXPORT(find_feet);
HWY_EXPORT(least_relative2);
HWY_EXPORT(find_counted_foot);
HWY_EXPORT(find_left_out);
HWY_EXPORT(nearest_shadow);

void Axes::add(const glm::dvec3& start, const glm::dvec3& along, double length, double radius, double slope,
               double beyond) {
    const auto put = [&](AxisRow row, double number) { rows.row(row)[count] = number; };
    put(kStartX, start.x), put(kStartY, start.y), put(kStartZ, start.z);
    put(kAlongX, along.x), put(kAlongY, along.y), put(kAlongZ, along.z);
    put(kAxisLength, length), put(kAxisRadius, radius), put(kAxisSlope, slope);
    put(kAxisBeyond, beyond);
    ++count;
}

void AxisFeet::reserve(std::size_t most) {
    rows.reserve(most);
    for (Near* const some : {&near, &marked})
        if (some->places.size() < most + NumberRows<1>::kWidestVector)
            some->places.resize(most + NumberRows<1>::kWidestVector);
}

void find_feet(const Axes& axes, const glm::dvec3& point, double radii, AxisFeet& feet) {
    HWY_DYNAMIC_DISPATCH(find_feet)(axes, point, radii, feet);
}

double least_relative2(const AxisFeet& feet, const AxisRelations& relations, std::size_t count) {
    return HWY_DYNAMIC_DISPATCH(least_relative2)(feet, relations, count);
}

std::optional<glm::dvec3> find_counted_foot(const Axes& counted, const glm::dvec3& point, const AxisFeet& feet,
                                            std::uint32_t own, const AxisRelations& relations) {
    return HWY_DYNAMIC_DISPATCH(find_counted_foot)(counted, point, feet, own, relations);
}

void find_left_out(const AxisFeet& feet, std::uint32_t own, const AxisRelations& relations, std::size_t count,
                   double* left) {
    HWY_DYNAMIC_DISPATCH(find_left_out)(feet, own, relations, count, left);
}

Shadow nearest_shadow(const ObstacleRows& obstacles, const ObstacleRange& range, const WayOut& way, double below) {
    if (range.count == 0 || !(way.length > 0.0)) return {};
    return HWY_DYNAMIC_DISPATCH(nearest_shadow)(obstacles, range, way, below);
}

// The shadow is left sideways where its side is nearer than its front, otherwise back along the way.
ShadowSide side_of_shadow(const ObstacleRows& obstacles, std::size_t obstacle, const WayOut& way) {
    const auto vector = [&](std::size_t row) {
        return glm::dvec3(obstacles.row(row)[obstacle], obstacles.row(row + 1)[obstacle],
                          obstacles.row(row + 2)[obstacle]);
    };
    const glm::dvec3 start = vector(kStartX), u = vector(kAlongX), across = start - way.foot;
    const double length = obstacles.row(kAxisLength)[obstacle];
    const double cosine = glm::dot(way.direction, u);
    double at = glm::dot(across, way.direction - cosine * u) / std::max(1.0 - cosine * cosine, 1e-12);
    const auto beside_way = [&] { return glm::dot(at * way.direction - across, u); };
    double beside = std::clamp(beside_way(), 0.0, length);
    if (beside <= 0.0 || beside >= length) {
        at = glm::dot(across + beside * u, way.direction);
        beside = std::clamp(beside_way(), 0.0, length);
    }
    const glm::dvec3 axis = start + beside * u;
    const glm::dvec3 off = way.foot + at * way.direction - axis;
    const double distance = glm::length(off);
    const double radius = obstacles.row(kAxisRadius)[obstacle] + beside * obstacles.row(kAxisSlope)[obstacle];
    const double lateral = (distance - radius) * std::min(way.length / at, 1.0);
    const glm::dvec3 move =
        vector(kMoveStartX) + beside / std::max(length, 1e-300) * (vector(kMoveEndX) - vector(kMoveStartX));
    const glm::dvec3 to_obstacle = axis + move - way.foot;
    const double ahead = glm::dot(to_obstacle, way.direction);
    const double middle =
        ahead > 0.0 ? 0.5 * glm::dot(to_obstacle, to_obstacle) / ahead : std::numeric_limits<double>::infinity();
    const double front = std::max(at, middle) - way.length;
    const bool is_front = front >= lateral || !(distance > 0.0);
    return {is_front ? way.direction : -off / distance, std::max(-front, 0.0)};
}

} // namespace ramus::field
#endif
