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

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <hwy/highway.h>
#include <type_traits>

HWY_BEFORE_NAMESPACE();
namespace ramus::field::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using D = hn::ScalableTag<float>;
using V = hn::Vec<D>;
using M = hn::Mask<D>;

// exp(-q) for q in [0, 80].
template <class Tag, class Vec = hn::Vec<Tag>> HWY_INLINE Vec exp_negative(Tag d, Vec q) {
    const hn::RebindToSigned<Tag> di;
    const Vec scaled = hn::Mul(q, hn::Set(d, -1.44269504F));
    const Vec whole = hn::Round(scaled);
    // ln 2 in two parts keeps the reduced argument exact.
    Vec f = hn::NegMulAdd(whole, hn::Set(d, 0.693359375F), hn::Neg(q));
    f = hn::NegMulAdd(whole, hn::Set(d, -2.12194440e-4F), f);
    Vec p = hn::MulAdd(f, hn::Set(d, 1.0F / 720.0F), hn::Set(d, 1.0F / 120.0F));
    p = hn::MulAdd(p, f, hn::Set(d, 1.0F / 24.0F));
    p = hn::MulAdd(p, f, hn::Set(d, 1.0F / 6.0F));
    p = hn::MulAdd(p, f, hn::Set(d, 0.5F));
    p = hn::MulAdd(p, f, hn::Set(d, 1.0F));
    p = hn::MulAdd(p, f, hn::Set(d, 1.0F));
    const auto exponent = hn::ShiftLeft<23>(hn::Add(hn::ConvertTo(di, whole), hn::Set(di, 127)));
    return hn::Mul(p, hn::BitCast(d, exponent));
}

inline constexpr float kErrorFunctionEnd = 3.5F;

// erf(x) as x times a polynomial in x^2 (degree 12, interpolated at the Chebyshev nodes of [0, 3.5^2]); beyond 3.5 the
// function is constant to 7.4e-7.
template <class Tag, class Vec = hn::Vec<Tag>> HWY_INLINE Vec error_function(Tag d, Vec x) {
    const Vec c = hn::Max(hn::Min(x, hn::Set(d, kErrorFunctionEnd)), hn::Set(d, -kErrorFunctionEnd));
    const Vec z = hn::MulSub(hn::Mul(c, c), hn::Set(d, 0.16326530612244897F), hn::Set(d, 1.0F));
    // Even and odd powers apart: two short chains instead of a long one.
    const Vec z2 = hn::Mul(z, z);
    Vec even = hn::Set(d, 0.0017147183F);
    even = hn::MulAdd(even, z2, hn::Set(d, 0.00384824956F));
    even = hn::MulAdd(even, z2, hn::Set(d, 0.0176693127F));
    even = hn::MulAdd(even, z2, hn::Set(d, 0.0447378904F));
    even = hn::MulAdd(even, z2, hn::Set(d, 0.0884569958F));
    even = hn::MulAdd(even, z2, hn::Set(d, 0.146746352F));
    even = hn::MulAdd(even, z2, hn::Set(d, 0.403873026F));
    Vec odd = hn::Set(d, -0.00413279235F);
    odd = hn::MulAdd(odd, z2, hn::Set(d, -0.00686586695F));
    odd = hn::MulAdd(odd, z2, hn::Set(d, -0.0303559396F));
    odd = hn::MulAdd(odd, z2, hn::Set(d, -0.0646453798F));
    odd = hn::MulAdd(odd, z2, hn::Set(d, -0.114632167F));
    odd = hn::MulAdd(odd, z2, hn::Set(d, -0.200700209F));
    return hn::Mul(c, hn::MulAdd(odd, z, even));
}

// One segment, broadcast to all lanes.
struct Segment {
    V ux, uy, uz, length, radius, slope;
};

HWY_INLINE Segment broadcast(D d, const FieldSegment& s) {
    return {hn::Set(d, s.ux),     hn::Set(d, s.uy),     hn::Set(d, s.uz),
            hn::Set(d, s.length), hn::Set(d, s.radius), hn::Set(d, s.slope)};
}

// The ends of a segment that some point of a box may be near. Elsewhere the end filter's error functions are constant,
// to the last bit, as they are along most of a long segment.
enum class Ends : std::uint8_t { kNone = 0, kStart = 1, kEnd = 2, kBoth = 3 };
constexpr bool near_start(Ends ends) { return ends == Ends::kStart || ends == Ends::kBoth; }
constexpr bool near_end(Ends ends) { return ends == Ends::kEnd || ends == Ends::kBoth; }

// `middle` of the box relative to the segment's start, and half its edges, mm.
inline Ends ends_near(const FieldSegment& s, float sqrt_w, glm::vec3 middle, glm::vec3 half) {
    const float t = s.ux * middle.x + s.uy * middle.y + s.uz * middle.z;
    const float along = std::abs(s.ux) * half.x + std::abs(s.uy) * half.y + std::abs(s.uz) * half.z;
    const auto radius = [&](float at) { return s.radius + s.slope * std::clamp(at, 0.0F, s.length); };
    // A little more than where the functions end covers the rounding.
    const float far = kErrorFunctionEnd * 1.001F * std::max(radius(t - along), radius(t + along));
    const int start = (t - along) * sqrt_w < far ? 1 : 0;
    const int end = (s.length - t - along) * sqrt_w < far ? 2 : 0;
    return static_cast<Ends>(start | end);
}

// Calls `add` with the ends as a template argument.
template <class Add> HWY_INLINE void for_ends(Ends near, const Add& add) {
    switch (near) {
    case Ends::kNone:
        return add(std::integral_constant<Ends, Ends::kNone>());
    case Ends::kStart:
        return add(std::integral_constant<Ends, Ends::kStart>());
    case Ends::kEnd:
        return add(std::integral_constant<Ends, Ends::kEnd>());
    case Ends::kBoth:
        return add(std::integral_constant<Ends, Ends::kBoth>());
    }
}

// A point seen from a segment. Lengths scaled by sqrt(w) / r are dimensionless: the kernel depends on nothing else.
struct Foot {
    V t;          // axial coordinate, mm
    V qx, qy, qz; // offset from the line, mm
    V scale;      // sqrt(w) / r at the foot, 1/mm
    V q;          // w d^2 / r^2
    V e;          // axial distance beyond the ends, scaled; 0 between them
    V rho;        // q + e^2: squared scaled distance to the segment
};

HWY_INLINE Foot find_foot(D d, const Segment& s, V sqrt_w, V px, V py, V pz) {
    Foot f;
    f.t = hn::MulAdd(pz, s.uz, hn::MulAdd(py, s.uy, hn::Mul(px, s.ux)));
    const V clamped = hn::Max(hn::Min(f.t, s.length), hn::Zero(d));
    // One step of Newton's method makes the quick reciprocal exact to single precision, at a third of a division's
    // time.
    const V radius = hn::MulAdd(s.slope, clamped, s.radius);
    const V guess = hn::ApproximateReciprocal(radius);
    f.scale = hn::Mul(sqrt_w, hn::Mul(guess, hn::NegMulAdd(radius, guess, hn::Set(d, 2.0F))));
    // The offset vector, not |p|^2 - t^2: beside a long segment the difference of squares would lose all digits.
    f.qx = hn::NegMulAdd(f.t, s.ux, px);
    f.qy = hn::NegMulAdd(f.t, s.uy, py);
    f.qz = hn::NegMulAdd(f.t, s.uz, pz);
    const V d2 = hn::MulAdd(f.qz, f.qz, hn::MulAdd(f.qy, f.qy, hn::Mul(f.qx, f.qx)));
    f.q = hn::Mul(d2, hn::Mul(f.scale, f.scale));
    f.e = hn::Mul(hn::Sub(f.t, clamped), f.scale);
    f.rho = hn::MulAdd(f.e, f.e, f.q);
    return f;
}

// Smooth step from 1 at kFadeBegin to exactly 0 at kFadeEnd, and its derivative with respect to rho.
template <class Tag, class Vec = hn::Vec<Tag>> HWY_INLINE Vec fade(Tag d, Vec rho) {
    const Vec x = hn::Mul(hn::Sub(hn::Set(d, static_cast<float>(kFadeEnd)), rho),
                          hn::Set(d, static_cast<float>(1.0 / (kFadeEnd - kFadeBegin))));
    const Vec c = hn::Max(hn::Min(x, hn::Set(d, 1.0F)), hn::Zero(d));
    return hn::Mul(hn::Mul(c, c), hn::NegMulAdd(hn::Set(d, 2.0F), c, hn::Set(d, 3.0F)));
}

HWY_INLINE V fade_slope(D d, V rho) {
    const V x = hn::Mul(hn::Sub(hn::Set(d, static_cast<float>(kFadeEnd)), rho),
                        hn::Set(d, static_cast<float>(1.0 / (kFadeEnd - kFadeBegin))));
    const V c = hn::Max(hn::Min(x, hn::Set(d, 1.0F)), hn::Zero(d));
    return hn::Mul(hn::Set(d, static_cast<float>(-6.0 / (kFadeEnd - kFadeBegin))),
                   hn::Mul(c, hn::Sub(hn::Set(d, 1.0F), c)));
}

HWY_INLINE M inside_support(D d, V rho) { return hn::Lt(rho, hn::Set(d, static_cast<float>(kFadeEnd))); }

// h and its gradient: grad h = radial * (qx, qy, qz) + axial * u.
struct KernelGradient {
    V value, radial, axial;
};

template <Ends Near> HWY_INLINE KernelGradient kernel_gradient(D d, const Segment& s, const Foot& f, V inverse_sqrt_w) {
    const V one = hn::Set(d, 1.0F);
    const V zero = hn::Zero(d);
    const V limit = hn::Set(d, 40.0F);
    const V gauss = exp_negative(d, hn::Min(f.q, limit));
    const V step = fade(d, f.rho);
    const V step_slope = fade_slope(d, f.rho);
    // Relative change of the radius per mm along the axis; none beyond the ends.
    const M between = hn::And(hn::Gt(f.t, zero), hn::Lt(f.t, s.length));
    const V growth = hn::IfThenElseZero(between, hn::Mul(s.slope, hn::Mul(f.scale, inverse_sqrt_w)));
    // The end filter and its slope, end by end; far from an end the slope is below 5e-6.
    V filter = hn::Set(d, 0.5F);
    V bell = zero;
    if constexpr (near_start(Near)) {
        const V a = hn::Mul(f.t, f.scale);
        filter = hn::Mul(filter, error_function(d, a));
        bell = hn::Mul(exp_negative(d, hn::Min(hn::Mul(a, a), limit)), hn::NegMulAdd(f.t, growth, one));
    }
    if constexpr (near_end(Near)) {
        const V to_end = hn::Sub(s.length, f.t);
        const V b = hn::Mul(to_end, f.scale);
        filter = hn::MulAdd(hn::Set(d, 0.5F), error_function(d, b), filter);
        bell = hn::NegMulAdd(exp_negative(d, hn::Min(hn::Mul(b, b), limit)), hn::MulAdd(to_end, growth, one), bell);
    } else {
        filter = hn::Add(filter, hn::Set(d, 0.5F));
    }
    const V filter_slope = hn::Mul(hn::Mul(f.scale, hn::Set(d, 0.564189584F)), bell); // 1 / sqrt(pi)
    const V q_slope = hn::Mul(hn::Mul(hn::Set(d, -2.0F), f.q), growth);
    const V rho_slope = hn::MulAdd(hn::Mul(hn::Set(d, 2.0F), f.e), f.scale, q_slope);
    const V body = hn::Mul(gauss, filter);
    KernelGradient g;
    g.value = hn::Mul(step, body);
    g.radial = hn::Mul(hn::Mul(hn::Set(d, 2.0F), hn::Mul(f.scale, f.scale)), hn::Mul(body, hn::Sub(step_slope, step)));
    g.axial = hn::MulAdd(hn::Mul(step, gauss), filter_slope,
                         hn::Mul(body, hn::NegMulAdd(step, q_slope, hn::Mul(step_slope, rho_slope))));
    return g;
}

} // namespace ramus::field::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
