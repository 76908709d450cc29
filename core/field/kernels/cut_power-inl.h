// CutPower: kernels that fall with a power of the distance (kernels/powers.h), as shapes of CompactLine. Included once
// per instruction set.
#if defined(RAMUS_FIELD_CUT_POWER_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef RAMUS_FIELD_CUT_POWER_INL_H
#undef RAMUS_FIELD_CUT_POWER_INL_H
#else
#define RAMUS_FIELD_CUT_POWER_INL_H
#endif

#include "core/field/kernels/compact_line-inl.h"
#include "core/field/kernels/powers.h"
#include "core/field/simd/math-inl.h"

#include <algorithm>
#include <cmath>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace ramus::field::HWY_NAMESPACE {

// g(u) = n [(u + e)^-k - a + b (u - reach^2)] with 2 k = kTwice, and a, b so that g and its slope are 0 at reach^2.
template <int kTwice> struct CutPower {
    static_assert(kTwice == 2 || kTwice == 3 || kTwice == 4);
    static constexpr float kPower = 0.5F * kTwice;
    float reach2, soft, factor, cut, cut_slope; // soft: e; factor: n
    float rest, whole; // the field of a long vessel is about whole / p^(2 k - 1) - rest, with p^2 = distance^2 + e

    HWY_INLINE explicit CutPower(const Kernel& kernel) {
        const CutPowerNumbers numbers(kernel);
        reach2 = static_cast<float>(numbers.reach2), soft = static_cast<float>(numbers.soft);
        factor = static_cast<float>(numbers.factor), cut = static_cast<float>(numbers.cut);
        cut_slope = static_cast<float>(numbers.cut_slope);
        rest = static_cast<float>(numbers.rest), whole = static_cast<float>(numbers.whole);
    }

    // The integrals of (p2 + x^2)^-k and of (p2 + x^2)^-(k + 1), for x from 0 to y.
    template <class Tag, class X> static HWY_INLINE X of_power(Tag d, X y, X p2) {
        const X r2 = mul_add(y, y, p2);
        if constexpr (kTwice == 3) return quotient(y, mul(p2, square_root(r2)));
        const X p = square_root(p2);
        const X angle = quotient(arc_tangent(quotient(y, p)), p);
        if constexpr (kTwice == 2) return angle;
        return quotient(mul(set(d, 0.5F), add(quotient(y, r2), angle)), p2);
    }
    template <class Tag, class X> static HWY_INLINE X of_next_power(Tag d, X y, X p2) {
        const X r2 = mul_add(y, y, p2);
        if constexpr (kTwice == 2) return CutPower<4>::of_power(d, y, p2);
        const X third = set(d, 1.0F / 3.0F);
        if constexpr (kTwice == 3) {
            const X inverse = quotient(set(d, 1.0F), r2);
            const X sum = mul_add(set(d, 2.0F), quotient(set(d, 1.0F), p2), inverse);
            return quotient(mul(mul(third, y), sum), mul(p2, square_root(r2)));
        }
        const X ends = quotient(quotient(y, r2), r2);
        return quotient(mul_add(set(d, 0.75F), of_power(d, y, p2), mul(set(d, 0.25F), ends)), p2);
    }

    template <class Tag, class X> HWY_INLINE X integral(Tag d, X y, X q, X room) const {
        const X lowered = mul_add(set(d, cut_slope), room, set(d, cut));
        const X cubic = mul(mul(y, y), set(d, cut_slope / 3.0F));
        return mul(set(d, factor), mul_add(y, sub(cubic, lowered), of_power(d, y, add(q, set(d, soft)))));
    }
    template <class Tag, class X> HWY_INLINE X slope(Tag d, X y, X q, X /*room*/) const {
        const X power = mul(set(d, kPower), of_next_power(d, y, add(q, set(d, soft))));
        return mul(set(d, factor), mul_sub(y, set(d, cut_slope), power));
    }
    template <class Tag, class X> HWY_INLINE X height(Tag d, X u) const {
        const X v = add(u, set(d, soft));
        X power = v;
        if constexpr (kTwice == 3) power = mul(v, square_root(v));
        if constexpr (kTwice == 4) power = mul(v, v);
        const X lowered = mul_add(set(d, cut_slope), sub(set(d, reach2), u), set(d, cut));
        return mul(set(d, factor), sub(quotient(set(d, 1.0F), power), lowered));
    }

    template <class Tag, class Vec = hn::Vec<Tag>> HWY_INLINE LongVesselPlace<Tag> distance(Tag d, Vec sum) const {
        const Vec share = hn::Max(hn::Mul(hn::Add(sum, hn::Set(d, rest)), hn::Set(d, 1.0F / whole)),
                                  hn::Set(d, 1e-9F)); // p^-(2 k - 1)
        Vec p2;
        if constexpr (kTwice == 2) p2 = hn::Div(hn::Set(d, 1.0F), hn::Mul(share, share));
        if constexpr (kTwice == 3) p2 = hn::Div(hn::Set(d, 1.0F), share);
        if constexpr (kTwice == 4) { // to the power -2/3
            const Vec third = hn::Mul(hn::Set(d, 2.0F / 3.0F), log2_of(d, share));
            const Vec size = power_negative(d, hn::Min(hn::Abs(third), hn::Set(d, 60.0F)));
            p2 = hn::IfThenElse(hn::Ge(third, hn::Zero(d)), size, hn::Div(hn::Set(d, 1.0F), size));
        }
        const Vec at = hn::Sqrt(hn::Max(hn::Sub(p2, hn::Set(d, soft)), hn::Set(d, 1e-3F)));
        const Vec fall = hn::Div(hn::Mul(hn::Mul(hn::Set(d, (kTwice - 1) * whole), share), at), p2);
        return {at, fall};
    }
    template <class Tag, class Vec = hn::Vec<Tag>> HWY_INLINE Vec rough_distance(Tag d, Vec value) const {
        return distance(d, value).distance;
    }
    HWY_INLINE float along_edge(float value) const {
        const float share = std::max((value + rest) / whole, 1e-9F);
        return -std::pow(share, -1.0F / static_cast<float>(kTwice - 1));
    }
};

} // namespace ramus::field::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
