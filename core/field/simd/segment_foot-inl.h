// The foot of a point on a segment, and types for a kernel's value there, in SIMD: one lane per point. Included once
// per instruction set.
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

// Whether the ends of a segment affect the kernel. kNone: both ends are so far away that they change no bit. kSome: at
// least one end is near; both are then evaluated, which costs less than a mispredicted branch.
enum class Ends : std::uint8_t { kNone = 0, kSome = 1 };

template <class Call> HWY_INLINE void for_ends(bool near, const Call& call) {
    if (near)
        call(std::integral_constant<Ends, Ends::kSome>());
    else
        call(std::integral_constant<Ends, Ends::kNone>());
}

// 1 / a: the approximate reciprocal and a Newton step, exact to single precision in a third of the time of a division.
template <class Tag, class Vec> HWY_INLINE Vec reciprocal(Tag d, Vec a) {
    const Vec guess = rough_reciprocal(a);
    return mul(guess, neg_mul_add(a, guess, set(d, 2.0F)));
}

// The members of FieldSegment that determine the radius, and the radius at an axial coordinate.
template <class Vec> struct RadiusLanes { Vec length, radius, slope, beyond; };
template <class Vec> struct RadiusThere {
    Vec radius;
    Vec excess;  // axial distance beyond the ends, signed, mm; 0 between them
    Vec carried; // factor of the slope's effect beyond an end; exactly 1 between the ends
};
template <class Tag, class Shape, class Vec>
HWY_INLINE RadiusThere<Vec> radius_along(Tag d, const Shape& s, const Vec& t) {
    const Vec zero = set(d, 0.0F);
    const Vec clamped = max(min(t, s.length), zero);
    const Vec excess = sub(t, clamped);
    const Vec at_end = mul_add(s.slope, clamped, s.radius);
    const Vec size = max(excess, sub(zero, excess));
    // 1e-9 avoids a division by 0 where `beyond` is 0.
    const Vec room = mul_add(max(s.beyond, set(d, 1e-9F)), at_end, size);
    const Vec carried = neg_mul_add(size, reciprocal(d, room), set(d, 1.0F));
    return {mul_add(mul(s.slope, excess), carried, at_end), excess, carried};
}

// The foot of a point on a segment. A scaled length is a length times the kernel's scale over the radius r at the foot,
// without a dimension. The kernel depends only on scaled lengths.
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
    // From the offset vector, not as |p|^2 - t^2: next to a long segment the difference of squares loses all digits.
    f.qx = neg_mul_add(f.t, s.ux, px);
    f.qy = neg_mul_add(f.t, s.uy, py);
    f.qz = neg_mul_add(f.t, s.uz, pz);
    const Pack<N, T> d2 = mul_add(f.qz, f.qz, mul_add(f.qy, f.qy, mul(f.qx, f.qx)));
    f.q = mul(d2, mul(f.scale, f.scale));
    f.e = mul(there.excess, f.scale);
    f.rho = mul_add(f.e, f.e, f.q);
    return f;
}

// The relative change of the radius per mm along the axis.
template <std::size_t N, class T>
HWY_INLINE Pack<N, T> growth_of(const Segments<N, T>& s, const Foot<N, T>& f, const Pack<N, T>& inverse_scale) {
    return mul(mul(s.slope, mul(f.carried, f.carried)), mul(f.scale, inverse_scale));
}

// A kernel h and its gradient: grad h = radial * (qx, qy, qz) + axial * u.
template <std::size_t N, class T = D> struct KernelGradient { Pack<N, T> value, radial, axial; };

// Boxes relative to one segment, one box per lane: their extents along the axis and away from it, from which bounds are
// computed. A cube with half edge h extends h (|nx| + |ny| + |nz|) from its middle along a direction n.
template <class Tag, class Vec = hn::Vec<Tag>> struct BoxView {
    Vec t, along;          // axial coordinate of the middle, and how far the box extends from it, mm
    Vec nearest, farthest; // least and greatest distance from the line, mm
    Vec beyond;            // axial distance of the middle beyond the ends, signed, mm
    Vec coarse, fine;      // the kernel's bound_scale / r for the largest and least radius that the box sees, 1/mm
};

// A Newton step onto the surface.
template <class Tag, class Vec = hn::Vec<Tag>> struct NewtonStep {
    Vec off;          // the error of the field in the kernel's measure; compared with the kernel's kShortStep
    Vec per_gradient; // the length of the step along the gradient, mm, times the length of the gradient
};

} // namespace ramus::field::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
