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

// The base-2 logarithm of a normal number, to 1.3e-7 (absolute, or of its size where that is above 1): log2(1 + t) / t
// interpolated at the Chebyshev nodes of 1 + t in [sqrt 1/2, sqrt 2].
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
// One over the square root, to single precision.
template <class Tag, class Vec> HWY_INLINE Vec reciprocal_root(Tag d, Vec x) {
    const Vec guess = hn::ApproximateReciprocalSqrt(x);
    const Vec half = hn::Mul(hn::Mul(hn::Set(d, 0.5F), x), guess);
    return hn::Mul(guess, hn::NegMulAdd(half, guess, hn::Set(d, 1.5F)));
}

inline constexpr float kErrorFunctionEnd = 3.5F;
inline constexpr float kFilterUnit = 0.404061018F; // of its argument, in the error function's: sqrt 2 / 3.5

// erf(y / kFilterUnit) / 2 is y times a polynomial in y^2 - 1 (interpolated at the Chebyshev nodes of [-1, 1]); beyond
// sqrt 2 it is constant to 3.7e-7. Here that polynomial, of N values side by side: one coefficient is fetched for all.
inline constexpr float kEndOfFilter = 1.41421356F;
template <class Tag, class Vec, std::size_t N> HWY_INLINE void end_polynomials(Tag d, const Vec (&y)[N], Vec (&p)[N]) {
    constexpr float kUnit = 0.5F / kFilterUnit;
    constexpr float kCoefficients[] = {-0.00413279235F, 0.00384824956F, -0.00686586695F, 0.0176693127F,
                                       -0.0303559396F,  0.0447378904F,  -0.0646453798F,  0.0884569958F,
                                       -0.114632167F,   0.146746352F,   -0.200700209F,   0.403873026F};
    Vec z[N];
    for (std::size_t n = 0; n < N; ++n) z[n] = mul_sub(y[n], y[n], set(d, 1.0F)), p[n] = set(d, kUnit * 0.0017147183F);
    for (const float coefficient : kCoefficients) {
        const Vec c = set(d, kUnit * coefficient);
        for (std::size_t n = 0; n < N; ++n) p[n] = mul_add(p[n], z[n], c);
    }
}
// erf(x) / 2.
template <class Tag, class Vec> HWY_INLINE Vec half_error_function(Tag d, Vec x) {
    const Vec y[1] = {limited(mul(x, set(d, kFilterUnit)), set(d, kEndOfFilter))};
    Vec p[1];
    end_polynomials(d, y, p);
    return mul(y[0], p[0]);
}

// Segments, each broadcast to all lanes.
template <std::size_t N, class T = D> struct Segments { Pack<N, T> ux, uy, uz, length, radius, slope; };

// Away from the ends of a long segment the end filter is constant, to the last bit: kNone. Near one of them counts as
// near both: the work for the other costs less than guessing a branch wrong.
enum class Ends : std::uint8_t { kNone = 0, kSome = 1 };

template <class Call> HWY_INLINE void for_ends(bool near, const Call& call) {
    if (near)
        call(std::integral_constant<Ends, Ends::kSome>());
    else
        call(std::integral_constant<Ends, Ends::kNone>());
}

// A point seen from a segment. Lengths scaled by sqrt(width) / r are dimensionless: the kernel depends on nothing else.
// In this scale its Gaussian is a power of two.
template <std::size_t N, class T = D> struct Foot {
    Pack<N, T> t;          // axial coordinate, mm
    Pack<N, T> qx, qy, qz; // offset from the line, mm
    Pack<N, T> scale;      // sqrt(width) / r at the foot, 1/mm
    Pack<N, T> q;          // width d^2 / r^2
    Pack<N, T> e;          // axial distance beyond the ends, scaled; 0 between them
    Pack<N, T> rho;        // q + e^2: squared scaled distance to the segment
};

inline constexpr float kNaturalLog = 0.693147181F; // of 2: from powers of two to those of e
inline constexpr float kFadeEndScaled = static_cast<float>(kFadeEnd * 1.4426950408889634);

template <std::size_t N, class T>
HWY_INLINE Foot<N, T> find_foot(const Segments<N, T>& s, const Pack<N, T>& root_width, const Pack<N, T>& px,
                                const Pack<N, T>& py, const Pack<N, T>& pz) {
    const PackTag<N, T> d;
    Foot<N, T> f;
    f.t = mul_add(pz, s.uz, mul_add(py, s.uy, mul(px, s.ux)));
    const Pack<N, T> clamped = max(min(f.t, s.length), set(d, 0.0F));
    // One step of Newton's method makes the quick reciprocal exact to single precision, at a third of a division's
    // time.
    const Pack<N, T> radius = mul_add(s.slope, clamped, s.radius);
    const Pack<N, T> guess = rough_reciprocal(radius);
    f.scale = mul(mul(root_width, guess), neg_mul_add(radius, guess, set(d, 2.0F)));
    // The offset vector, not |p|^2 - t^2: beside a long segment the difference of squares would lose all digits.
    f.qx = neg_mul_add(f.t, s.ux, px);
    f.qy = neg_mul_add(f.t, s.uy, py);
    f.qz = neg_mul_add(f.t, s.uz, pz);
    const Pack<N, T> d2 = mul_add(f.qz, f.qz, mul_add(f.qy, f.qy, mul(f.qx, f.qx)));
    f.q = mul(d2, mul(f.scale, f.scale));
    f.e = mul(sub(f.t, clamped), f.scale);
    f.rho = mul_add(f.e, f.e, f.q);
    return f;
}

// Smooth step of rho times `unit`, from 1 at kFadeBegin to exactly 0 at kFadeEnd, in two parts: how far it is from the
// end, 0 to 1, and what that comes to.
template <class Tag, class Vec> HWY_INLINE Vec fade_place(Tag d, Vec rho, double unit) {
    constexpr double kInverse = 1.0 / (kFadeEnd - kFadeBegin);
    const Vec x =
        neg_mul_add(rho, set(d, static_cast<float>(unit * kInverse)), set(d, static_cast<float>(kFadeEnd * kInverse)));
    return max(min(x, set(d, 1.0F)), set(d, 0.0F));
}
template <class Tag, class Vec> HWY_INLINE Vec fade_at(Tag d, Vec c) {
    return mul(mul(c, c), neg_mul_add(set(d, 2.0F), c, set(d, 3.0F)));
}
template <class Tag, class Vec> HWY_INLINE Vec fade(Tag d, Vec rho) { return fade_at(d, fade_place(d, rho, 1.0)); }

// The Gaussian, and squares that go into another one, end where single precision does.
template <std::size_t N, class T> HWY_INLINE Pack<N, T> gaussian(const Pack<N, T>& q) {
    const PackTag<N, T> d;
    return power_negative(d, min(q, set(d, 64.0F)));
}

// The end filter, 1/2 [erf + erf] of the scaled distances from both ends.
template <Ends Near, std::size_t N, class T>
HWY_INLINE Pack<N, T> end_filter(const Segments<N, T>& s, const Foot<N, T>& f) {
    const PackTag<N, T> d;
    const Pack<N, T> scale = mul(f.scale, set(d, kFilterUnit * 0.832554611F)); // sqrt(ln 2)
    const Pack<N, T> end = set(d, kEndOfFilter);
    Pack<N, T> y[2] = {end, end};
    if constexpr (Near == Ends::kSome)
        y[0] = limited(mul(f.t, scale), end), y[1] = limited(mul(sub(s.length, f.t), scale), end);
    Pack<N, T> p[2];
    end_polynomials(d, y, p);
    return mul_add(y[0], p[0], mul(y[1], p[1]));
}

// The kernels of a pack of segments at a vector of points.
template <Ends Near, std::size_t N, class T>
HWY_INLINE Pack<N, T> kernel_value(const Segments<N, T>& s, const Foot<N, T>& f) {
    const PackTag<N, T> d;
    const Pack<N, T> body = mul(gaussian(f.q), fade_at(d, fade_place(d, f.rho, kNaturalLog)));
    return mul(body, end_filter<Near>(s, f));
}

// h and its gradient: grad h = radial * (qx, qy, qz) + axial * u.
template <std::size_t N, class T = D> struct KernelGradient { Pack<N, T> value, radial, axial; };

template <Ends Near, std::size_t N, class T>
HWY_INLINE KernelGradient<N, T> kernel_gradient(const Segments<N, T>& s, const Foot<N, T>& f,
                                                const Pack<N, T>& inverse_root) {
    const PackTag<N, T> d;
    const Pack<N, T> one = set(d, 1.0F);
    const Pack<N, T> gauss = gaussian(f.q);
    const Pack<N, T> c = fade_place(d, f.rho, kNaturalLog);
    const Pack<N, T> step = fade_at(d, c);
    const Pack<N, T> step_slope = mul(mul(set(d, static_cast<float>(-6.0 / (kFadeEnd - kFadeBegin))), c), sub(one, c));
    // Relative change of the radius per mm along the axis; none beyond the ends.
    const Pack<N, T> growth = where_between(set(d, 0.0F), f.t, s.length, mul(s.slope, mul(f.scale, inverse_root)));
    const Pack<N, T> body = mul(gauss, end_filter<Near>(s, f));
    const Pack<N, T> twice_scale = mul(set(d, 2.0F * kNaturalLog), f.scale);
    const Pack<N, T> q_slope = mul(mul(set(d, -2.0F * kNaturalLog), f.q), growth);
    const Pack<N, T> rho_slope = mul_add(twice_scale, f.e, q_slope);
    KernelGradient<N, T> g;
    g.value = mul(step, body);
    g.radial = mul(mul(twice_scale, f.scale), mul(body, sub(step_slope, step)));
    g.axial = mul(body, neg_mul_add(step, q_slope, mul(step_slope, rho_slope)));
    if constexpr (Near == Ends::kSome) { // far from the ends the filter's slope is below 5e-6
        const Pack<N, T> to_end = sub(s.length, f.t);
        const Pack<N, T> a = mul(f.t, f.scale);
        const Pack<N, T> b = mul(to_end, f.scale);
        const Pack<N, T> bell_a = mul(gaussian(mul(a, a)), neg_mul_add(f.t, growth, one));
        const Pack<N, T> bell = neg_mul_add(gaussian(mul(b, b)), mul_add(to_end, growth, one), bell_a);
        const Pack<N, T> filter_slope = mul(mul(f.scale, set(d, 0.469718639F)), bell); // sqrt(ln 2 / pi)
        g.axial = mul_add(mul(step, gauss), filter_slope, g.axial);
    }
    return g;
}

} // namespace ramus::field::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
