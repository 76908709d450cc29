// A point seen from a segment, and what a kernel is there, in SIMD: one lane per point. Included once per instruction
// set.
#if defined(RAMUS_FIELD_SEGMENT_FOOT_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef RAMUS_FIELD_SEGMENT_FOOT_INL_H
#undef RAMUS_FIELD_SEGMENT_FOOT_INL_H
#else
#define RAMUS_FIELD_SEGMENT_FOOT_INL_H
#endif

#include "core/field/simd/pack-inl.h"

#include <cstdint>
#include <hwy/highway.h>
#include <type_traits>

HWY_BEFORE_NAMESPACE();
namespace ramus::field::HWY_NAMESPACE {

// Segments, each broadcast to all lanes.
template <std::size_t N, class T = D> struct Segments { Pack<N, T> ux, uy, uz, length, radius, slope, beyond; };

// Away from the ends of a long segment a kernel does not change along it, to the last bit: kNone. Near one of them
// counts as near both: the work for the other costs less than guessing a branch wrong.
enum class Ends : std::uint8_t { kNone = 0, kSome = 1 };

template <class Call> HWY_INLINE void for_ends(bool near, const Call& call) {
    if (near)
        call(std::integral_constant<Ends, Ends::kSome>());
    else
        call(std::integral_constant<Ends, Ends::kNone>());
}

// One over a number: one step of Newton's method makes the quick reciprocal exact to single precision, at a third of a
// division's time.
template <class Tag, class Vec> HWY_INLINE Vec reciprocal(Tag d, Vec a) {
    const Vec guess = rough_reciprocal(a);
    return mul(guess, neg_mul_add(a, guess, set(d, 2.0F)));
}

// What the radius of a segment is made of (FieldSegment), and the radius at an axial coordinate.
template <class Vec> struct RadiusLanes { Vec length, radius, slope, beyond; };
template <class Vec> struct RadiusThere {
    Vec radius;
    Vec excess;  // axial distance beyond the ends, signed, mm; 0 between them
    Vec carried; // share of the slope's effect that is left there: 1 between the ends, to the last bit
};
template <class Tag, class Shape, class Vec>
HWY_INLINE RadiusThere<Vec> radius_along(Tag d, const Shape& s, const Vec& t) {
    const Vec zero = set(d, 0.0F);
    const Vec clamped = max(min(t, s.length), zero);
    const Vec excess = sub(t, clamped);
    const Vec at_end = mul_add(s.slope, clamped, s.radius);
    const Vec size = max(excess, sub(zero, excess));
    // Nothing is divided by 0: that far radii are not resolved anyway.
    const Vec room = mul_add(max(s.beyond, set(d, 1e-9F)), at_end, size);
    const Vec carried = neg_mul_add(size, reciprocal(d, room), set(d, 1.0F));
    return {mul_add(mul(s.slope, excess), carried, at_end), excess, carried};
}

// A point seen from a segment. Lengths times the kernel's scale, over the radius r at the foot, have no dimension: the
// kernel depends on nothing else.
template <std::size_t N, class T = D> struct Foot {
    Pack<N, T> t;          // axial coordinate, mm
    Pack<N, T> qx, qy, qz; // offset from the line, mm
    Pack<N, T> scale;      // the kernel's scale / r at the foot, 1/mm
    Pack<N, T> q;          // squared scaled distance d to the line
    Pack<N, T> e;          // axial distance beyond the ends, scaled; 0 between them
    Pack<N, T> rho;        // q + e^2: squared scaled distance to the segment
    Pack<N, T> carried;    // as in RadiusThere
};

template <Ends Near, std::size_t N, class T>
HWY_INLINE Foot<N, T> find_foot(const Segments<N, T>& s, const Pack<N, T>& scale, const Pack<N, T>& px,
                                const Pack<N, T>& py, const Pack<N, T>& pz) {
    const PackTag<N, T> d;
    Foot<N, T> f;
    f.t = mul_add(pz, s.uz, mul_add(py, s.uy, mul(px, s.ux)));
    RadiusThere<Pack<N, T>> there{mul_add(s.slope, f.t, s.radius), set(d, 0.0F), set(d, 1.0F)};
    if constexpr (Near == Ends::kSome) there = radius_along(d, s, f.t);
    const Pack<N, T> guess = rough_reciprocal(there.radius);
    f.scale = mul(mul(scale, guess), neg_mul_add(there.radius, guess, set(d, 2.0F)));
    f.carried = there.carried;
    // The offset vector, not |p|^2 - t^2: beside a long segment the difference of squares would lose all digits.
    f.qx = neg_mul_add(f.t, s.ux, px);
    f.qy = neg_mul_add(f.t, s.uy, py);
    f.qz = neg_mul_add(f.t, s.uz, pz);
    const Pack<N, T> d2 = mul_add(f.qz, f.qz, mul_add(f.qy, f.qy, mul(f.qx, f.qx)));
    f.q = mul(d2, mul(f.scale, f.scale));
    f.e = mul(there.excess, f.scale);
    f.rho = mul_add(f.e, f.e, f.q);
    return f;
}

// Relative change of the radius per mm along the axis.
template <std::size_t N, class T>
HWY_INLINE Pack<N, T> growth_of(const Segments<N, T>& s, const Foot<N, T>& f, const Pack<N, T>& inverse_scale) {
    return mul(mul(s.slope, mul(f.carried, f.carried)), mul(f.scale, inverse_scale));
}

// A kernel h and its gradient: grad h = radial * (qx, qy, qz) + axial * u.
template <std::size_t N, class T = D> struct KernelGradient { Pack<N, T> value, radial, axial; };

// Boxes seen from one segment, a box a lane. How far a box extends along the axis and away from it is what bounds are
// made of: along a direction n a cube reaches h (|nx| + |ny| + |nz|) to either side of its middle, h being half its
// edge.
template <class Tag, class Vec = hn::Vec<Tag>> struct BoxView {
    Vec t, along;          // axial coordinate of the middle, and how far the box extends from it, mm
    Vec nearest, farthest; // least and greatest distance from the line, mm
    Vec beyond;            // axial distance of the middle beyond the ends, signed, mm
    Vec coarse, fine;      // the kernel's bound_scale / r where the box sees the segment thickest and thinnest, 1/mm
};

// What a step of Newton's method onto the surface comes to: how far off the field is, in the kernel's own measure, and
// the length of the step times the gradient's, which only the gradient's direction and length are needed for.
template <class Tag, class Vec = hn::Vec<Tag>> struct NewtonStep {
    Vec off;          // |off| is compared with the kernel's kShortStep
    Vec per_gradient; // along the field's gradient, mm times its length
};

} // namespace ramus::field::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
