// CompactLine: the SIMD profile of kernels that are line integrals of a function with compact support. Included once
// per instruction set.
//
// Such a kernel has a function g of the squared distance u from a point of the skeleton, in local radii, which falls
// smoothly to exactly 0 at u = reach^2. The contribution of a segment is the integral of g along it, in closed form:
//     h(p) = integral of g(q + x^2) dx from -t / r to (L - t) / r,   q = d^2 / r^2
// with t, d and r as for the Gaussian (kernels/gaussian.h). r is the radius at the foot, and all lengths are in units
// of r. A straight vessel of constant radius has the same field however it is divided into segments, since the
// integrals add up.
//
// A Shape is constructed from a Kernel and has these members, for vectors and for packs of vectors:
//     integral(d, y, q, room)    integral of g(q + x^2) for x from 0 to y, odd in y; room = reach^2 - q; y^2 <= room
//     slope(d, y, q, room)       the derivative of integral() by q
//     height(d, u)               g(u)
//     distance(d, sum)           the distance from a long vessel's axis, in radii, at which the field is `sum`, and the
//                                amount by which the field falls per radius there; approximate, but exact at 1 radius
//     reach2                     reach^2
//     rough_distance(d, value), along_edge(value)   as in a profile (sum/plain_sum-inl.h)
#if defined(RAMUS_FIELD_COMPACT_LINE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef RAMUS_FIELD_COMPACT_LINE_INL_H
#undef RAMUS_FIELD_COMPACT_LINE_INL_H
#else
#define RAMUS_FIELD_COMPACT_LINE_INL_H
#endif

#include "core/field/kernel.h"
#include "core/field/simd/segment_foot-inl.h"

#include <hwy/contrib/math/math-inl.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace ramus::field::HWY_NAMESPACE {

template <class X> HWY_INLINE X square_root(X a) {
    return on_each([](auto x) { return hn::Sqrt(x); }, a);
}
template <class X> HWY_INLINE X quotient(X a, X b) {
    return on_each([](auto x, auto y) { return hn::Div(x, y); }, a, b);
}
template <class X> HWY_INLINE X arc_tangent(X a) {
    return on_each([]<class Vec>(Vec x) { return hn::Atan(hn::DFromV<Vec>(), x); }, a);
}

// The result of Shape::distance().
template <class Tag, class Vec = hn::Vec<Tag>> struct LongVesselPlace { Vec distance, fall; };

template <class Shape> struct CompactLine {
    float scale = 1.0F, bound_scale = 1.0F;
    static constexpr float kShortStep = 0.05F; // radii; as short as that of the Gaussian
    Shape shape;

    HWY_INLINE explicit CompactLine(const Kernel& kernel) : shape(kernel) {}

    // The limits of the integral: the scaled distances of the two ends, clamped to the reach.
    template <Ends Near, std::size_t N, class T> struct Window {
        Pack<N, T> room, y[2];
        HWY_INLINE Window(const Segments<N, T>& s, const Foot<N, T>& f, float reach2) {
            const PackTag<N, T> d;
            room = max(sub(set(d, reach2), f.q), set(d, 0.0F));
            y[0] = y[1] = square_root(room);
            if constexpr (Near == Ends::kSome) {
                y[0] = limited(mul(f.t, f.scale), y[1]);
                y[1] = limited(mul(sub(s.length, f.t), f.scale), y[1]);
            }
        }
    };

    template <Ends Near, std::size_t N, class T>
    HWY_INLINE Pack<N, T> value(const Segments<N, T>& s, const Foot<N, T>& f) const {
        const PackTag<N, T> d;
        const Window<Near, N, T> w(s, f, shape.reach2);
        return add(shape.integral(d, w.y[0], f.q, w.room), shape.integral(d, w.y[1], f.q, w.room));
    }

    template <Ends Near, std::size_t N, class T>
    HWY_INLINE KernelGradient<N, T> gradient(const Segments<N, T>& s, const Foot<N, T>& f,
                                             const Pack<N, T>& growth) const {
        const PackTag<N, T> d;
        const Window<Near, N, T> w(s, f, shape.reach2);
        KernelGradient<N, T> g;
        g.value = add(shape.integral(d, w.y[0], f.q, w.room), shape.integral(d, w.y[1], f.q, w.room));
        const Pack<N, T> by_q = add(shape.slope(d, w.y[0], f.q, w.room), shape.slope(d, w.y[1], f.q, w.room));
        g.radial = mul(mul(set(d, 2.0F), mul(f.scale, f.scale)), by_q);
        g.axial = mul(mul(set(d, -2.0F), by_q), mul(f.q, growth));
        if constexpr (Near == Ends::kSome) { // otherwise g is 0 at both ends
            const Pack<N, T> u0 = min(mul_add(w.y[0], w.y[0], f.q), set(d, shape.reach2));
            const Pack<N, T> u1 = min(mul_add(w.y[1], w.y[1], f.q), set(d, shape.reach2));
            g.axial = mul_add(shape.height(d, u0), neg_mul_add(w.y[0], growth, f.scale), g.axial);
            g.axial = neg_mul_add(shape.height(d, u1), mul_add(w.y[1], growth, f.scale), g.axial);
        }
        return g;
    }

    // An upper bound of h over a box is the smaller one of two: the integral with both ends as far outward as the box
    // allows, which is tight for long segments; and the integral over a piece of the segment's length as near to the
    // box as possible, which is tight for short segments. lower_bound() is the reverse. The upper bound uses the
    // thickest radius that the box sees, the lower bound the thinnest.
    template <class Tag, class Vec = hn::Vec<Tag>>
    HWY_INLINE Vec upper_bound(Tag d, const CullingSegment& s, const BoxView<Tag>& box) const {
        const Vec zero = hn::Zero(d), length = hn::Set(d, s.length);
        const Vec q = hn::Mul(hn::Mul(box.nearest, box.nearest), hn::Mul(box.coarse, box.coarse));
        const auto outward = [&](Vec v) { return hn::Mul(v, hn::IfThenElse(hn::Ge(v, zero), box.fine, box.coarse)); };
        const Vec ends = integral_from_to(d, q, outward(hn::Add(box.t, box.along)),
                                          outward(hn::Sub(hn::Add(length, box.along), box.t)));
        const Vec half = hn::Mul(hn::Set(d, 0.5F), length);
        const Vec aside = hn::Mul(hn::Max(hn::Sub(hn::Abs(hn::Sub(box.t, half)), box.along), zero), box.coarse);
        const Vec reach = hn::Mul(half, box.fine);
        const Vec piece = integral_from_to(d, q, hn::Add(reach, aside), hn::Sub(reach, aside));
        return hn::Mul(hn::Set(d, 1.0F + kRounding), hn::Min(ends, piece));
    }
    template <class Tag, class Vec = hn::Vec<Tag>>
    HWY_INLINE Vec lower_bound(Tag d, const CullingSegment& s, const BoxView<Tag>& box, hn::Mask<Tag> reaches) const {
        const Vec zero = hn::Zero(d), length = hn::Set(d, s.length);
        const Vec scaled = hn::Mul(box.farthest, box.fine), q = hn::Mul(scaled, scaled);
        if (hn::AllFalse(d, hn::And(reaches, hn::Lt(q, hn::Set(d, shape.reach2))))) return zero;
        const auto inward = [&](Vec v) { return hn::Mul(v, hn::IfThenElse(hn::Ge(v, zero), box.coarse, box.fine)); };
        const Vec ends = integral_from_to(d, q, inward(hn::Sub(box.t, box.along)),
                                          inward(hn::Sub(hn::Sub(length, box.along), box.t)));
        const Vec half = hn::Mul(hn::Set(d, 0.5F), length);
        const Vec aside = hn::Mul(hn::Add(hn::Abs(hn::Sub(box.t, half)), box.along), box.fine);
        const Vec reach = hn::Mul(half, box.coarse);
        const Vec piece = integral_from_to(d, q, hn::Add(reach, aside), hn::Sub(reach, aside));
        return hn::Max(zero, hn::Mul(hn::Set(d, 1.0F - kRounding), hn::Max(ends, piece)));
    }

    template <class Tag, class Vec = hn::Vec<Tag>> HWY_INLINE NewtonStep<Tag> newton(Tag d, Vec sum) const {
        const LongVesselPlace<Tag> place = shape.distance(d, sum);
        const Vec off = hn::Sub(place.distance, hn::Set(d, 1.0F));
        // d(distance) / d(sum) = -1 / fall.
        return {off, hn::Mul(off, place.fall)};
    }
    template <class Tag, class Vec = hn::Vec<Tag>> HWY_INLINE Vec rough_distance(Tag d, Vec value) const {
        return shape.rough_distance(d, value);
    }
    HWY_INLINE float along_edge(float value) const { return shape.along_edge(value); }

private:
    static constexpr float kRounding = 3e-5F; // relative; rounding of small differences of integrals

    template <class Tag, class Vec = hn::Vec<Tag>>
    HWY_INLINE Vec integral_from_to(Tag d, Vec q, Vec to_start, Vec to_end) const {
        const Vec room = hn::Max(hn::Sub(hn::Set(d, shape.reach2), q), hn::Zero(d));
        const Vec most = hn::Sqrt(room);
        return hn::Max(hn::Zero(d), hn::Add(shape.integral(d, limited(to_start, most), q, room),
                                            shape.integral(d, limited(to_end, most), q, room)));
    }
};

} // namespace ramus::field::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
