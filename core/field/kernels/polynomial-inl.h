// Quartic: the polynomial of kernels/polynomial.h, as a shape of CompactLine. Included once per instruction set.
#if defined(RAMUS_FIELD_POLYNOMIAL_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef RAMUS_FIELD_POLYNOMIAL_INL_H
#undef RAMUS_FIELD_POLYNOMIAL_INL_H
#else
#define RAMUS_FIELD_POLYNOMIAL_INL_H
#endif

#include "core/field/kernels/compact_line-inl.h"
#include "core/field/simd/math-inl.h"

#include <algorithm>
#include <cmath>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace ramus::field::HWY_NAMESPACE {

// g(u) = n (R^2 - u)^2, n = 15/16 R^-5: 1 on the axis of an endless line.
struct Quartic {
    // The distance from the axis, in radii, that first guesses assume for a point outside of the support, where the
    // field is 0: about where the next grid point may be.
    static constexpr float kOutside = 1.2F;
    float reach2, factor;

    HWY_INLINE explicit Quartic(const Kernel& kernel)
        : reach2(static_cast<float>(kernel.support_radii * kernel.support_radii)),
          factor(static_cast<float>(15.0 / 16.0 * std::pow(kernel.support_radii, -5.0))) {}

    template <class Tag, class X> HWY_INLINE X integral(Tag d, X y, X /*q*/, X room) const {
        const X y2 = mul(y, y);
        const X tail = mul_add(y2, set(d, 0.2F), mul(set(d, -2.0F / 3.0F), room));
        return mul(mul(set(d, factor), y), mul_add(y2, tail, mul(room, room)));
    }
    template <class Tag, class X> HWY_INLINE X slope(Tag d, X y, X /*q*/, X room) const {
        const X part = neg_mul_add(mul(y, y), set(d, 1.0F / 3.0F), room);
        return mul(mul(set(d, -2.0F * factor), y), part);
    }
    template <class Tag, class X> HWY_INLINE X height(Tag d, X u) const {
        const X left = sub(set(d, reach2), u);
        return mul(set(d, factor), mul(left, left));
    }

    // The field of a long vessel is (1 - distance^2 / R^2)^(5/2).
    template <class Tag, class Vec = hn::Vec<Tag>> HWY_INLINE LongVesselPlace<Tag> distance(Tag d, Vec sum) const {
        const Vec some = hn::Max(sum, hn::Set(d, 1e-20F));
        const Vec exponent = hn::Mul(hn::Set(d, -0.4F), log2_of(d, some)); // negative where the sum is above 1
        const Vec size = power_negative(d, hn::Min(hn::Abs(exponent), hn::Set(d, 60.0F)));
        const Vec share = hn::IfThenElse(hn::Ge(exponent, hn::Zero(d)), size, hn::Div(hn::Set(d, 1.0F), size));
        const Vec of_reach2 = hn::Max(hn::Sub(hn::Set(d, 1.0F), share), hn::Set(d, 1e-3F));
        const Vec at = hn::Sqrt(hn::Mul(of_reach2, hn::Set(d, reach2)));
        const Vec fall = hn::Div(hn::Mul(hn::Set(d, 5.0F / reach2), hn::Mul(at, some)), share);
        return {at, fall};
    }
    template <class Tag, class Vec = hn::Vec<Tag>> HWY_INLINE Vec rough_distance(Tag d, Vec value) const {
        const Vec at = distance(d, value).distance;
        return hn::IfThenElse(hn::Gt(value, hn::Zero(d)), at, hn::Max(at, hn::Set(d, kOutside)));
    }
    HWY_INLINE float along_edge(float value) const {
        const float at = std::sqrt(reach2 * std::max(1.0F - std::pow(std::max(value, 0.0F), 0.4F), 1e-3F));
        return value > 0.0F ? -at : -std::max(at, kOutside);
    }
};

} // namespace ramus::field::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
