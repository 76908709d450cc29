// Elementary functions in single precision, for vectors and packs of vectors. Included once per instruction set.
#if defined(RAMUS_FIELD_MATH_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef RAMUS_FIELD_MATH_INL_H
#undef RAMUS_FIELD_MATH_INL_H
#else
#define RAMUS_FIELD_MATH_INL_H
#endif

#include "core/field/simd/pack-inl.h"

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace ramus::field::HWY_NAMESPACE {

inline constexpr float kNaturalLog = 0.693147181F; // ln 2

// 2^-q for q in [0, 116]; the polynomial is 2^f, interpolated at the Chebyshev nodes of [-1/2, 1/2], and 1 at 0.
template <class Tag, class Vec> HWY_INLINE Vec power_negative(Tag d, Vec q) {
    // Adding this rounds to a whole number and leaves it in the lowest bits.
    const Vec shift = set(d, 12582912.0F); // 1.5 2^23
    const Vec shifted = sub(shift, q);
    const Vec f = sub(sub(shift, shifted), q);
    Vec p = mul_add(f, set(d, 0.00133908634F), set(d, 0.00967603192F));
    p = mul_add(p, f, set(d, 0.0555035711F));
    p = mul_add(p, f, set(d, 0.240221075F));
    p = mul_add(p, f, set(d, 0.693147188F));
    p = mul_add(p, f, set(d, 1.0F));
    return times_power(p, shifted);
}
// exp(-q) for q in [0, 80].
template <class Tag, class Vec> HWY_INLINE Vec exp_negative(Tag d, Vec q) {
    return power_negative(d, mul(q, set(d, 1.44269504F)));
}

// The base-2 logarithm of a normal number, with an error of 1.3e-7 (absolute, or relative where the result is above 1):
// log2(1 + t) / t, interpolated at the Chebyshev nodes of 1 + t in [sqrt 1/2, sqrt 2].
template <class Tag, class Vec> HWY_INLINE Vec log2_of(Tag d, Vec x) {
    constexpr float kCoefficients[] = {0.23265257F,  -0.24927182F, 0.28728887F, -0.36022517F,
                                       0.480916708F, -0.72135293F, 1.442695022F};
    const hn::RebindToSigned<Tag> di;
    const auto root_half = hn::Set(di, 0x3F3504F3);
    const auto above = hn::Sub(hn::BitCast(di, x), root_half);
    const Vec exponent = hn::ConvertTo(d, hn::ShiftRight<23>(above));
    const auto fraction = hn::Add(hn::And(above, hn::Set(di, 0x7FFFFF)), root_half);
    const Vec t = hn::Sub(hn::BitCast(d, fraction), hn::Set(d, 1.0F));
    Vec p = hn::Set(d, -0.14275974F);
    for (const float coefficient : kCoefficients) p = hn::MulAdd(p, t, hn::Set(d, coefficient));
    return hn::MulAdd(p, t, exponent);
}
// The reciprocal square root, to single precision.
template <class Tag, class Vec> HWY_INLINE Vec reciprocal_root(Tag d, Vec x) {
    const Vec guess = hn::ApproximateReciprocalSqrt(x);
    const Vec half = hn::Mul(hn::Mul(hn::Set(d, 0.5F), x), guess);
    return hn::Mul(guess, hn::NegMulAdd(half, guess, hn::Set(d, 1.5F)));
}

} // namespace ramus::field::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
