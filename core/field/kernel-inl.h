// The convolution kernel in SIMD, one lane per point: values, gradients and bounds. Included once per instruction set
// (Highway's foreach_target), hence no include guard of the usual kind.
//
// Accuracy: absolute error of h below 1e-6 inside the support (erf 5.3e-7 at worst, exp 2e-7 relative), against the
// formula in double precision. Outside the support the result is exactly zero, which is what makes a sum over any list
// that contains the supporting segments, in the same order, the same to the last bit.
#if defined(RAMUS_FIELD_KERNEL_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef RAMUS_FIELD_KERNEL_INL_H
#undef RAMUS_FIELD_KERNEL_INL_H
#else
#define RAMUS_FIELD_KERNEL_INL_H
#endif

#include "core/field/convolution_field.h"
#include "core/field/pack-inl.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <hwy/highway.h>
#include <type_traits>

HWY_BEFORE_NAMESPACE();
namespace ramus::field::HWY_NAMESPACE {

// exp(-q) for q in [0, 80], as a power of two; the polynomial is 2^f, interpolated at the Chebyshev nodes of
// [-1/2, 1/2], and 1 at 0.
template <class Tag, class Vec> HWY_INLINE Vec exp_negative(Tag d, Vec q) {
    // Adding this rounds to a whole number and leaves it in the lowest bits.
    const Vec shift = set(d, 12582912.0F); // 1.5 2^23
    const Vec power = mul(q, set(d, -1.44269504F));
    const Vec shifted = add(power, shift);
    const Vec f = sub(power, sub(shifted, shift));
    Vec p = mul_add(f, set(d, 0.00133908634F), set(d, 0.00967603192F));
    p = mul_add(p, f, set(d, 0.0555035711F));
    p = mul_add(p, f, set(d, 0.240221075F));
    p = mul_add(p, f, set(d, 0.693147188F));
    p = mul_add(p, f, set(d, 1.0F));
    return times_power(p, shifted);
}

inline constexpr float kErrorFunctionEnd = 3.5F;

// erf(x) / 2 as x times a polynomial in x^2 (degree 12, interpolated at the Chebyshev nodes of [0, 3.5^2]); beyond 3.5
// the function is constant to 7.4e-7.
template <class Tag, class Vec> HWY_INLINE Vec half_error_function(Tag d, Vec x) {
    const Vec c = max(min(x, set(d, kErrorFunctionEnd)), set(d, -kErrorFunctionEnd));
    const Vec z = mul_sub(mul(c, c), set(d, 0.16326530612244897F), set(d, 1.0F));
    // Even and odd powers apart: two short chains instead of a long one.
    const Vec z2 = mul(z, z);
    Vec even = set(d, 0.5F * 0.0017147183F);
    even = mul_add(even, z2, set(d, 0.5F * 0.00384824956F));
    even = mul_add(even, z2, set(d, 0.5F * 0.0176693127F));
    even = mul_add(even, z2, set(d, 0.5F * 0.0447378904F));
    even = mul_add(even, z2, set(d, 0.5F * 0.0884569958F));
    even = mul_add(even, z2, set(d, 0.5F * 0.146746352F));
    even = mul_add(even, z2, set(d, 0.5F * 0.403873026F));
    Vec odd = set(d, 0.5F * -0.00413279235F);
    odd = mul_add(odd, z2, set(d, 0.5F * -0.00686586695F));
    odd = mul_add(odd, z2, set(d, 0.5F * -0.0303559396F));
    odd = mul_add(odd, z2, set(d, 0.5F * -0.0646453798F));
    odd = mul_add(odd, z2, set(d, 0.5F * -0.114632167F));
    odd = mul_add(odd, z2, set(d, 0.5F * -0.200700209F));
    return mul(c, mul_add(odd, z, even));
}

// Segments, each broadcast to all lanes.
struct Segments {
    Pack ux, uy, uz, length, radius, slope;
};

// Away from the ends of a long segment the end filter is constant, to the last bit: kNone. Near one of them counts as
// near both: the work for the other costs less than guessing a branch wrong.
enum class Ends : std::uint8_t { kNone = 0, kSome = 1 };

template <class Call> HWY_INLINE void for_ends(Ends near, const Call& call) {
    if (near == Ends::kNone)
        call(std::integral_constant<Ends, Ends::kNone>());
    else
        call(std::integral_constant<Ends, Ends::kSome>());
}

// A point seen from a segment. Lengths scaled by sqrt(w) / r are dimensionless: the kernel depends on nothing else.
struct Foot {
    Pack t;          // axial coordinate, mm
    Pack qx, qy, qz; // offset from the line, mm
    Pack scale;      // sqrt(w) / r at the foot, 1/mm
    Pack q;          // w d^2 / r^2
    Pack e;          // axial distance beyond the ends, scaled; 0 between them
    Pack rho;        // q + e^2: squared scaled distance to the segment
};

HWY_INLINE Foot find_foot(const Segments& s, Pack sqrt_w, Pack px, Pack py, Pack pz) {
    const PackTag d;
    Foot f;
    f.t = mul_add(pz, s.uz, mul_add(py, s.uy, mul(px, s.ux)));
    const Pack clamped = max(min(f.t, s.length), set(d, 0.0F));
    // One step of Newton's method makes the quick reciprocal exact to single precision, at a third of a division's
    // time.
    const Pack radius = mul_add(s.slope, clamped, s.radius);
    const Pack guess = rough_reciprocal(radius);
    f.scale = mul(mul(sqrt_w, guess), neg_mul_add(radius, guess, set(d, 2.0F)));
    // The offset vector, not |p|^2 - t^2: beside a long segment the difference of squares would lose all digits.
    f.qx = neg_mul_add(f.t, s.ux, px);
    f.qy = neg_mul_add(f.t, s.uy, py);
    f.qz = neg_mul_add(f.t, s.uz, pz);
    const Pack d2 = mul_add(f.qz, f.qz, mul_add(f.qy, f.qy, mul(f.qx, f.qx)));
    f.q = mul(d2, mul(f.scale, f.scale));
    f.e = mul(sub(f.t, clamped), f.scale);
    f.rho = mul_add(f.e, f.e, f.q);
    return f;
}

// Smooth step from 1 at kFadeBegin to exactly 0 at kFadeEnd, and its derivative with respect to rho.
template <class Tag, class Vec> HWY_INLINE Vec fade_place(Tag d, Vec rho) {
    constexpr double kInverse = 1.0 / (kFadeEnd - kFadeBegin);
    const Vec x =
        neg_mul_add(rho, set(d, static_cast<float>(kInverse)), set(d, static_cast<float>(kFadeEnd * kInverse)));
    return max(min(x, set(d, 1.0F)), set(d, 0.0F));
}
template <class Tag, class Vec> HWY_INLINE Vec fade(Tag d, Vec rho) {
    const Vec c = fade_place(d, rho);
    return mul(mul(c, c), neg_mul_add(set(d, 2.0F), c, set(d, 3.0F)));
}

// The end filter: 1/2 [erf(a) + erf(b)].
template <Ends Near> HWY_INLINE Pack end_filter(Pack a, Pack b) {
    const PackTag d;
    const Pack saturated = half_error_function(d, set(d, kErrorFunctionEnd));
    if constexpr (Near == Ends::kNone) return add(saturated, saturated);
    return add(half_error_function(d, a), half_error_function(d, b));
}

// The kernels of two segments, at as many vectors of points as there are.
template <Ends Near> HWY_INLINE Pack kernel_value(const Segments& s, const Foot& f) {
    const PackTag d;
    const Pack body = mul(exp_negative(d, min(f.q, set(d, 40.0F))), fade(d, f.rho));
    return mul(body, end_filter<Near>(mul(f.t, f.scale), mul(sub(s.length, f.t), f.scale)));
}

// h and its gradient: grad h = radial * (qx, qy, qz) + axial * u.
struct KernelGradient {
    Pack value, radial, axial;
};

template <Ends Near> HWY_INLINE KernelGradient kernel_gradient(const Segments& s, const Foot& f, Pack inverse_sqrt_w) {
    const PackTag d;
    const Pack one = set(d, 1.0F);
    const Pack two = set(d, 2.0F);
    const Pack limit = set(d, 40.0F);
    const Pack gauss = exp_negative(d, min(f.q, limit));
    const Pack c = fade_place(d, f.rho);
    const Pack step = mul(mul(c, c), neg_mul_add(two, c, set(d, 3.0F)));
    const Pack step_slope = mul(mul(set(d, static_cast<float>(-6.0 / (kFadeEnd - kFadeBegin))), c), sub(one, c));
    // Relative change of the radius per mm along the axis; none beyond the ends.
    const Pack growth = where_between(set(d, 0.0F), f.t, s.length, mul(s.slope, mul(f.scale, inverse_sqrt_w)));
    const Pack to_end = sub(s.length, f.t);
    const Pack a = mul(f.t, f.scale);
    const Pack b = mul(to_end, f.scale);
    const Pack filter = end_filter<Near>(a, b);
    const Pack body = mul(gauss, filter);
    const Pack q_slope = mul(mul(set(d, -2.0F), f.q), growth);
    const Pack rho_slope = mul_add(mul(two, f.e), f.scale, q_slope);
    KernelGradient g;
    g.value = mul(step, body);
    g.radial = mul(mul(two, mul(f.scale, f.scale)), mul(body, sub(step_slope, step)));
    g.axial = mul(body, neg_mul_add(step, q_slope, mul(step_slope, rho_slope)));
    if constexpr (Near == Ends::kSome) { // far from the ends the filter's slope is below 5e-6
        const Pack bell_a = mul(exp_negative(d, min(mul(a, a), limit)), neg_mul_add(f.t, growth, one));
        const Pack bell = neg_mul_add(exp_negative(d, min(mul(b, b), limit)), mul_add(to_end, growth, one), bell_a);
        const Pack filter_slope = mul(mul(f.scale, set(d, 0.564189584F)), bell); // 1 / sqrt(pi)
        g.axial = mul_add(mul(step, gauss), filter_slope, g.axial);
    }
    return g;
}

} // namespace ramus::field::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
