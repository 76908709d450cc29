#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/measure/deviation/packed_queries.cpp"
// clang-format off: foreach_target compiles this file once per instruction set and must come first.
#include <hwy/foreach_target.h>
// clang-format on
#include "core/measure/deviation/packed_queries.h"

#include <cmath>
#include <hwy/highway.h>
#include <limits>

HWY_BEFORE_NAMESPACE();
namespace ramus::measure::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Singles = hn::CappedTag<float, kPack>;
using Doubles = hn::CappedTag<double, kPack>;
using Values = hn::Vec<Doubles>;

struct Vector {
    Values x, y, z;
};

// Without fused multiply-add, so that the result has the same bits on all instruction sets.
HWY_INLINE Vector minus(const Vector& a, const Vector& b) {
    return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
}
HWY_INLINE Values dot(const Vector& a, const Vector& b) {
    return hn::Add(hn::Add(hn::Mul(a.x, b.x), hn::Mul(a.y, b.y)), hn::Mul(a.z, b.z));
}
// The result for (b, a) has the opposite sign and otherwise the same bits, so the two triangles of an edge agree on the
// side of a line.
HWY_INLINE Vector cross(const Vector& a, const Vector& b) {
    return {hn::Sub(hn::Mul(a.y, b.z), hn::Mul(b.y, a.z)), hn::Sub(hn::Mul(a.z, b.x), hn::Mul(b.z, a.x)),
            hn::Sub(hn::Mul(a.x, b.y), hn::Mul(b.x, a.y))};
}
HWY_INLINE Vector all(const double* v) {
    const Doubles d;
    return {hn::Set(d, v[0]), hn::Set(d, v[1]), hn::Set(d, v[2])};
}
// Loads floats from `at` as doubles.
HWY_INLINE Values wide(const float* at) {
    return hn::PromoteTo(Doubles(), hn::LoadU(hn::Rebind<float, Doubles>(), at));
}
HWY_INLINE Vector corner(const PackedLeaf& leaf, int number, std::size_t n) {
    return {wide(leaf.corner[number][0] + n), wide(leaf.corner[number][1] + n), wide(leaf.corner[number][2] + n)};
}

// The leaf `number`; filled into `room` if leaves are not stored.
HWY_INLINE const PackedLeaf& leaf_of(const PackedView& view, std::uint32_t number, PackedLeaf& room) {
    if (view.leaves != nullptr) return view.leaves[number];
    fill_leaf(view, number, room);
    return room;
}

// Squared distance from the origin to the line from `a` along `edge`.
HWY_INLINE Values to_edge(const Vector& a, const Vector& edge) {
    const Doubles d;
    const Values squared = hn::Max(dot(edge, edge), hn::Set(d, 1e-300)); // of no length: its end
    const Values share = hn::Min(hn::Max(hn::Div(hn::Neg(dot(a, edge)), squared), hn::Zero(d)), hn::Set(d, 1.0));
    const Vector nearest = {hn::Add(a.x, hn::Mul(share, edge.x)), hn::Add(a.y, hn::Mul(share, edge.y)),
                            hn::Add(a.z, hn::Mul(share, edge.z))};
    return dot(nearest, nearest);
}

// Squared distance from the origin to triangles: to the plane if the foot lies within the triangle, else to the nearest
// edge.
HWY_INLINE Values to_triangle(const Vector& a, const Vector& b, const Vector& c) {
    const Doubles d;
    const Vector ab = minus(b, a), bc = minus(c, b), ca = minus(a, c);
    const Vector normal = cross(ab, bc);
    const Values area = dot(normal, normal);
    const Values zero = hn::Zero(d);
    const auto within = hn::And(hn::And(hn::Ge(dot(cross(a, b), normal), zero), hn::Ge(dot(cross(b, c), normal), zero)),
                                hn::And(hn::Ge(dot(cross(c, a), normal), zero), hn::Gt(area, zero)));
    const Values height = dot(a, normal);
    const Values edges = hn::Min(hn::Min(to_edge(a, ab), to_edge(b, bc)), to_edge(c, ca));
    const Values plane = hn::Div(hn::Mul(height, height), hn::Max(area, hn::Set(d, 1e-300)));
    return hn::IfThenElse(within, hn::Min(plane, edges), edges);
}

HWY_INLINE double least_squared(const PackedLeaf& leaf, const Vector& point) {
    const Doubles d;
    Values least = hn::Set(d, 1e300);
    for (std::size_t n = 0; n < kPack; n += hn::Lanes(d))
        least = hn::Min(least, to_triangle(minus(corner(leaf, 0, n), point), minus(corner(leaf, 1, n), point),
                                           minus(corner(leaf, 2, n), point)));
    return hn::GetLane(hn::MinOfLanes(d, least));
}

// Squared distances to the boxes of a node, rounded.
HWY_INLINE void to_boxes(const EightBoxes& node, const float* point, float* squared) {
    const Singles d;
    for (std::size_t n = 0; n < kPack; n += hn::Lanes(d)) {
        auto sum = hn::Zero(d);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto at = hn::Set(d, point[axis]);
            const auto off = hn::Max(hn::Max(hn::Sub(hn::LoadU(d, node.least(axis) + n), at),
                                             hn::Sub(at, hn::LoadU(d, node.most(axis) + n))),
                                     hn::Zero(d));
            sum = hn::Add(sum, hn::Mul(off, off));
        }
        hn::StoreU(sum, d, squared + n);
    }
}

struct Open {
    std::uint32_t node, level; // of a leaf kLeafLevel
    float bound;
};
constexpr std::uint32_t kLeafLevel = 0xFFFFFFFFU;
constexpr std::size_t kMostOpen = 12 * kPack; // a node leaves seven of its children behind, at each level

// A margin for the rounding of box distances to single precision, a few parts in 10^7.
HWY_INLINE float limit_of(double squared) { return static_cast<float>(squared * (1.0 + 4e-6)); }

HWY_INLINE double nearest_squared(const PackedView& view, const float* place, std::uint32_t& leaf) {
    const double place_wide[3] = {place[0], place[1], place[2]};
    const Vector point = all(place_wide);
    PackedLeaf room;
    double best = least_squared(leaf_of(view, leaf, room), point);
    const std::uint32_t begin = leaf;
    float limit = limit_of(best);
    Open open[kMostOpen];
    open[0] = {0, view.level_count - 1, 0.0F};
    std::size_t count = 1;
    while (count > 0) {
        const Open next = open[--count];
        if (!(next.bound <= limit)) continue;
        if (next.level == kLeafLevel) {
            if (next.node == begin) continue;
            const double squared = least_squared(leaf_of(view, next.node, room), point);
            if (squared >= best) continue;
            best = squared;
            limit = limit_of(best);
            leaf = next.node;
            continue;
        }
        float squared[kPack];
        to_boxes(view.levels[next.level][next.node], place, squared);
        const std::uint32_t below = next.level == 0 ? kLeafLevel : next.level - 1;
        const std::size_t first = count;
        for (std::uint32_t child = 0; child < kPack; ++child) {
            if (!(squared[child] <= limit)) continue;
            // The nearest child is pushed last, so that it is visited first.
            std::size_t at = count++;
            for (; at > first && open[at - 1].bound < squared[child]; --at) open[at] = open[at - 1];
            open[at] = {next.node * kPack + child, below, squared[child]};
        }
    }
    return best;
}

void distances_of(const PackedView& view, const glm::vec3* points, const std::uint32_t* order, std::size_t count,
                  double* distances) {
    std::uint32_t leaf = 0;
    for (std::size_t i = 0; i < count; ++i)
        distances[order[i]] = std::sqrt(nearest_squared(view, &points[order[i]].x, leaf));
}

// The bits of the boxes of a node that a line intersects, and the parameter at which it enters each. Has a margin, so
// that rounding does not lose a flat box.
HWY_INLINE std::uint32_t boxes_met(const EightBoxes& node, const double* from, const double* inverse, double length,
                                   double* begins) {
    const Doubles d;
    std::uint32_t bits = 0;
    for (std::size_t n = 0; n < kPack; n += hn::Lanes(d)) {
        Values enter = hn::Zero(d), leave = hn::Set(d, length);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const Values start = hn::Set(d, from[axis]), per = hn::Set(d, inverse[axis]);
            const Values low = hn::Mul(hn::Sub(wide(node.least(axis) + n), start), per);
            const Values high = hn::Mul(hn::Sub(wide(node.most(axis) + n), start), per);
            enter = hn::Max(enter, hn::Min(low, high));
            leave = hn::Min(leave, hn::Max(low, high));
        }
        const Values slack = hn::Mul(hn::Set(d, 1e-9), hn::Add(hn::Abs(leave), hn::Set(d, 1.0)));
        std::uint8_t byte[8] = {};
        const auto is_there = hn::Le(wide(node.least(0) + n), wide(node.most(0) + n));
        hn::StoreMaskBits(d, hn::And(is_there, hn::Le(enter, hn::Add(leave, slack))), byte);
        bits |= static_cast<std::uint32_t>(byte[0]) << n;
        hn::StoreU(enter, d, begins + n);
    }
    return bits;
}

// A line intersects a triangle if it passes all three edges on the same side. A line through an edge intersects both
// triangles, at the same place.
HWY_INLINE std::size_t crossings_of(const PackedView& view, std::uint32_t number, const Vector& from,
                                    const Vector& direction, double length, Crossing* found) {
    PackedLeaf room;
    const PackedLeaf& leaf = leaf_of(view, number, room);
    const Doubles d;
    const Values zero = hn::Zero(d);
    std::size_t count = 0;
    for (std::size_t n = 0; n < kPack; n += hn::Lanes(d)) {
        const Vector a = minus(corner(leaf, 0, n), from), b = minus(corner(leaf, 1, n), from),
                     c = minus(corner(leaf, 2, n), from);
        const Values of_c = dot(direction, cross(a, b)), of_a = dot(direction, cross(b, c)),
                     of_b = dot(direction, cross(c, a));
        const Values sum = hn::Add(hn::Add(of_a, of_b), of_c);
        const auto out =
            hn::And(hn::And(hn::Ge(of_a, zero), hn::Ge(of_b, zero)), hn::And(hn::Ge(of_c, zero), hn::Gt(sum, zero)));
        const auto in =
            hn::And(hn::And(hn::Le(of_a, zero), hn::Le(of_b, zero)), hn::And(hn::Le(of_c, zero), hn::Lt(sum, zero)));
        if (hn::AllFalse(d, hn::Or(out, in))) continue;
        const Values way = hn::Div(hn::Add(hn::Add(hn::Mul(of_a, dot(a, direction)), hn::Mul(of_b, dot(b, direction))),
                                           hn::Mul(of_c, dot(c, direction))),
                                   sum);
        double at[kPack];
        std::uint8_t is_out[8] = {}, is_in[8] = {};
        hn::StoreU(way, d, at);
        hn::StoreMaskBits(d, out, is_out);
        hn::StoreMaskBits(d, in, is_in);
        for (std::uint32_t lane = 0; lane < hn::Lanes(d); ++lane) {
            const bool leaves = (is_out[0] >> lane & 1U) != 0;
            if (!leaves && (is_in[0] >> lane & 1U) == 0) continue;
            if (at[lane] >= 0.0 && at[lane] <= length)
                found[count++] = {at[lane], leaves, number * kPack + static_cast<std::uint32_t>(n) + lane};
        }
    }
    return count;
}

std::size_t crossings_along(const PackedView& view, const double* from, const double* direction, double length,
                            Crossing* found, std::size_t room) {
    double inverse[3];
    for (int axis = 0; axis < 3; ++axis) inverse[axis] = 1.0 / (direction[axis] != 0.0 ? direction[axis] : 1e-300);
    const Vector start = all(from), way = all(direction);
    Open open[kMostOpen];
    open[0] = {0, view.level_count - 1, 0.0F};
    std::size_t count = 1, total = 0;
    while (count > 0) {
        const Open next = open[--count];
        if (next.level == kLeafLevel) {
            Crossing here[kPack];
            const std::size_t more = crossings_of(view, next.node, start, way, length, here);
            for (std::size_t i = 0; i < more; ++i, ++total)
                if (total < room) found[total] = here[i];
            continue;
        }
        double begins[kPack];
        const EightBoxes& node = view.levels[next.level][next.node];
        const std::uint32_t bits = boxes_met(node, from, inverse, length, begins);
        const std::uint32_t below = next.level == 0 ? kLeafLevel : next.level - 1;
        for (std::uint32_t child = 0; child < kPack; ++child)
            if ((bits >> child & 1U) != 0) open[count++] = {next.node * kPack + child, below, 0.0F};
    }
    return total;
}

Crossing exit_along(const PackedView& view, const double* from, const double* direction, double after) {
    double inverse[3];
    for (int axis = 0; axis < 3; ++axis) inverse[axis] = 1.0 / (direction[axis] != 0.0 ? direction[axis] : 1e-300);
    const Vector start = all(from), way = all(direction);
    Crossing first{std::numeric_limits<double>::infinity(), true, 0};
    Open open[kMostOpen];
    open[0] = {0, view.level_count - 1, 0.0F};
    std::size_t count = 1;
    while (count > 0) {
        const Open next = open[--count];
        if (static_cast<double>(next.bound) > first.at) continue;
        if (next.level == kLeafLevel) {
            Crossing here[kPack];
            const std::size_t more = crossings_of(view, next.node, start, way, first.at, here);
            for (std::size_t i = 0; i < more; ++i) {
                const Crossing& exit = here[i];
                // A line through an edge leaves two triangles at one place. The lower one is taken, whatever the order
                // of the search.
                const bool sooner = exit.at < first.at || (exit.at == first.at && exit.triangle < first.triangle);
                if (exit.out && exit.at > after && sooner) first = exit;
            }
            continue;
        }
        double begins[kPack];
        const EightBoxes& node = view.levels[next.level][next.node];
        const std::uint32_t bits = boxes_met(node, from, inverse, first.at, begins);
        const std::uint32_t below = next.level == 0 ? kLeafLevel : next.level - 1;
        const std::size_t earlier = count;
        for (std::uint32_t child = 0; child < kPack; ++child) {
            if ((bits >> child & 1U) == 0) continue;
            const auto bound = static_cast<float>(begins[child] * (1.0 - 1e-6)); // not above it
            // The child that the line enters first is pushed last, so that it is visited first.
            std::size_t at = count++;
            for (; at > earlier && open[at - 1].bound < bound; --at) open[at] = open[at - 1];
            open[at] = {next.node * kPack + child, below, bound};
        }
    }
    return first;
}

} // namespace ramus::measure::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace ramus::measure {

HWY_EXPORT(distances_of);
HWY_EXPORT(crossings_along);
HWY_EXPORT(exit_along);

void packed_distances(const PackedView& view, const glm::vec3* points, const std::uint32_t* order, std::size_t count,
                      double* distances) {
    HWY_DYNAMIC_DISPATCH(distances_of)(view, points, order, count, distances);
}

std::size_t packed_crossings(const PackedView& view, const double* from, const double* direction, double length,
                             Crossing* found, std::size_t room) {
    return HWY_DYNAMIC_DISPATCH(crossings_along)(view, from, direction, length, found, room);
}

Crossing packed_exit(const PackedView& view, const double* from, const double* direction, double after) {
    return HWY_DYNAMIC_DISPATCH(exit_along)(view, from, direction, after);
}

} // namespace ramus::measure
#endif
