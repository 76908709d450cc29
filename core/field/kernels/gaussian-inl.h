// The SIMD profile of the Gaussian (kernels/gaussian.h): values, gradients and bounds. Included once per instruction
// set.
//
// Accuracy: the absolute error of h is below 1e-6 inside the support, compared with the formula in double precision
// (erf 5.3e-7 at worst, exp 2e-7 relative). Outside the support the result is exactly 0. So a sum over any list that
// contains the reaching segments in ascending order has the same bits.
#if defined(RAMUS_FIELD_GAUSSIAN_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef RAMUS_FIELD_GAUSSIAN_INL_H
#undef RAMUS_FIELD_GAUSSIAN_INL_H
#else
#define RAMUS_FIELD_GAUSSIAN_INL_H
#endif

#include "core/field/kernels/gaussian.h"
#include "core/field/simd/math-inl.h"
#include "core/field/simd/segment_foot-inl.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <hwy/highway.h>
#include <numbers>

HWY_BEFORE_NAMESPACE();
namespace ramus::field::HWY_NAMESPACE {

inline constexpr float kFilterUnit = 0.404061018F; // sqrt 2 / 3.5: scales the argument of erf to [-sqrt 2, sqrt 2]

// erf(y / kFilterUnit) / 2 is y times a polynomial in y^2 - 1 (interpolated at the Chebyshev nodes of [-1, 1]); beyond
// |y| = sqrt 2 it is constant to 3.7e-7. This function evaluates the polynomial for N vectors, and loads each
// coefficient once.
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

inline constexpr float kFadeEndScaled = static_cast<float>(kFadeEnd * 1.4426950408889634);

// A smooth step of rho times `unit`, from 1 at kFadeBegin to exactly 0 at kFadeEnd. fade_place() is its linear
// argument, from 1 to 0; fade_at() is the cubic of this argument.
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

// 2^-q; q is clamped to the range of power_negative().
template <std::size_t N, class T> HWY_INLINE Pack<N, T> power_of_two(const Pack<N, T>& q) {
    const PackTag<N, T> d;
    return power_negative(d, min(q, set(d, 64.0F)));
}

// Values and gradients use lengths scaled by sqrt(width) / r, so that the Gaussian is a power of 2. Bounds and depths
// use the scale sqrt(w) / r, so that the Gaussian is a power of e.
struct Gaussian {
    float scale, bound_scale;
    float surface_depth; // phi at the isovalue: sqrt(w)

    HWY_INLINE explicit Gaussian(const Kernel& kernel)
        : scale(static_cast<float>(std::sqrt(kernel.width))),
          bound_scale(static_cast<float>(std::sqrt(kernel.width * std::numbers::ln2))), surface_depth(bound_scale) {}

    // The end filter, 1/2 [erf + erf] of the scaled distances from both ends.
    template <Ends Near, std::size_t N, class T>
    static HWY_INLINE Pack<N, T> end_filter(const Segments<N, T>& s, const Foot<N, T>& f) {
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
    static HWY_INLINE Pack<N, T> value(const Segments<N, T>& s, const Foot<N, T>& f) {
        const PackTag<N, T> d;
        const Pack<N, T> body = mul(power_of_two(f.q), fade_at(d, fade_place(d, f.rho, kNaturalLog)));
        return mul(body, end_filter<Near>(s, f));
    }

    // h and its gradient. `growth`: growth_of().
    template <Ends Near, std::size_t N, class T>
    static HWY_INLINE KernelGradient<N, T> gradient(const Segments<N, T>& s, const Foot<N, T>& f,
                                                    const Pack<N, T>& growth) {
        const PackTag<N, T> d;
        const Pack<N, T> one = set(d, 1.0F);
        const Pack<N, T> gauss = power_of_two(f.q);
        const Pack<N, T> c = fade_place(d, f.rho, kNaturalLog);
        const Pack<N, T> step = fade_at(d, c);
        const Pack<N, T> step_slope =
            mul(mul(set(d, static_cast<float>(-6.0 / (kFadeEnd - kFadeBegin))), c), sub(one, c));
        const Pack<N, T> body = mul(gauss, end_filter<Near>(s, f));
        const Pack<N, T> twice_scale = mul(set(d, 2.0F * kNaturalLog), f.scale);
        const Pack<N, T> twice_growth = mul(set(d, -2.0F * kNaturalLog), growth);
        const Pack<N, T> q_slope = mul(f.q, twice_growth);
        const Pack<N, T> rho_slope = mul_add(twice_scale, f.e, mul(f.rho, twice_growth));
        KernelGradient<N, T> g;
        g.value = mul(step, body);
        g.radial = mul(mul(twice_scale, f.scale), mul(body, sub(step_slope, step)));
        g.axial = mul(body, neg_mul_add(step, q_slope, mul(step_slope, rho_slope)));
        if constexpr (Near == Ends::kSome) { // far from the ends the filter's slope is below 5e-6
            const Pack<N, T> to_end = sub(s.length, f.t);
            const Pack<N, T> a = mul(f.t, f.scale);
            const Pack<N, T> b = mul(to_end, f.scale);
            const Pack<N, T> bell_a = mul(power_of_two(mul(a, a)), neg_mul_add(f.t, growth, one));
            const Pack<N, T> bell = neg_mul_add(power_of_two(mul(b, b)), mul_add(to_end, growth, one), bell_a);
            const Pack<N, T> filter_slope = mul(mul(f.scale, set(d, 0.469718639F)), bell); // sqrt(ln 2 / pi)
            g.axial = mul_add(mul(step, gauss), filter_slope, g.axial);
        }
        return g;
    }

    // An upper bound of h over boxes that the segment reaches.
    template <class Tag, class Vec = hn::Vec<Tag>>
    static HWY_INLINE Vec upper_bound(Tag d, const CullingSegment& s, const BoxView<Tag>& box) {
        const Vec zero = hn::Zero(d);
        const Vec length = hn::Set(d, s.length);
        const Vec middle = hn::Mul(hn::Set(d, 0.5F), length);
        // The end filter is highest nearest to the segment's middle, lowest farthest from it; erf grows with its
        // argument, so each term takes the radius that bounds it.
        const Vec q_min = hn::Mul(box.nearest, box.coarse);
        const Vec t_best = hn::Max(hn::Min(middle, hn::Add(box.t, box.along)), hn::Sub(box.t, box.along));
        const auto term = [&](Vec v) {
            return half_error_function(d, hn::Mul(v, hn::IfThenElse(hn::Ge(v, zero), box.fine, box.coarse)));
        };
        const Vec filter = hn::Add(term(t_best), term(hn::Sub(length, t_best)));
        const Vec gauss = exp_negative(d, hn::Min(hn::Mul(q_min, q_min), hn::Set(d, 40.0F)));
        return hn::Mul(gauss, filter);
    }
    // A lower bound of h over boxes; only valid for boxes that the segment `reaches`.
    template <class Tag, class Vec = hn::Vec<Tag>>
    static HWY_INLINE Vec lower_bound(Tag d, const CullingSegment& s, const BoxView<Tag>& box, hn::Mask<Tag> reaches) {
        const Vec zero = hn::Zero(d);
        const Vec q_max = hn::Mul(box.farthest, box.fine);
        const Vec e_max = hn::Mul(hn::Add(hn::Abs(box.beyond), box.along), box.fine);
        const Vec rho_max = hn::MulAdd(e_max, e_max, hn::Mul(q_max, q_max));
        if (hn::AllFalse(d, hn::And(reaches, hn::Lt(rho_max, hn::Set(d, static_cast<float>(kFadeEnd)))))) return zero;
        const Vec length = hn::Set(d, s.length);
        const Vec middle = hn::Mul(hn::Set(d, 0.5F), length);
        const Vec t_worst = hn::IfThenElse(hn::Gt(box.t, middle), hn::Add(box.t, box.along), hn::Sub(box.t, box.along));
        const auto term = [&](Vec v) {
            return half_error_function(d, hn::Mul(v, hn::IfThenElse(hn::Ge(v, zero), box.coarse, box.fine)));
        };
        const Vec filter = hn::Max(zero, hn::Add(term(t_worst), term(hn::Sub(length, t_worst))));
        const Vec gauss = hn::Mul(exp_negative(d, hn::Min(hn::Mul(q_max, q_max), hn::Set(d, 40.0F))), fade(d, rho_max));
        return hn::Mul(gauss, filter);
    }

    // phi = sqrt(-ln F) is linear in the distance from a straight vessel's axis, so that one step of Newton's method is
    // exact there.
    template <class Tag, class Vec = hn::Vec<Tag>> HWY_INLINE NewtonStep<Tag> newton(Tag d, Vec sum) const {
        const Vec f = hn::Max(hn::Min(sum, hn::Set(d, 0.999F)), hn::Set(d, 1e-7F));
        const Vec phi2 = hn::Mul(log2_of(d, f), hn::Set(d, -kNaturalLog));
        const Vec phi = hn::Mul(phi2, reciprocal_root(d, phi2));
        const Vec off = hn::Sub(phi, hn::Set(d, surface_depth));
        // grad phi = -grad F / (2 F phi), so the step is (target - phi) grad phi / |grad phi|^2.
        return {off, hn::Mul(hn::Mul(off, hn::Set(d, 2.0F)), hn::Mul(f, phi))};
    }
    // In r / sqrt(w). After a first step shorter than this the second step is skipped. Then 99.9 % of the vertices of
    // real trees are within 0.30 % of their radius (most trees: 0.05 to 0.15 %), compared with 0.18 % if the second
    // step is always taken.
    static constexpr float kShortStep = 0.10F;

    // phi in its own scale, to 0.01. Enough for first guesses, which Newton's method corrects.
    template <class Tag, class Vec = hn::Vec<Tag>> static HWY_INLINE Vec rough_distance(Tag d, Vec value) {
        const hn::RebindToSigned<Tag> di;
        const auto bits = hn::BitCast(di, hn::Max(value, hn::Set(d, 1e-8F)));
        const Vec exponent = hn::ConvertTo(d, hn::Sub(hn::ShiftRight<23>(bits), hn::Set(di, 127)));
        const Vec m = hn::BitCast(d, hn::Or(hn::And(bits, hn::Set(di, 0x7FFFFF)), hn::Set(di, 0x3F800000)));
        const Vec fraction =
            hn::MulAdd(hn::MulAdd(hn::Set(d, -0.33333333F), m, hn::Set(d, 2.0F)), m, hn::Set(d, -1.66666667F));
        const Vec square = hn::Max(hn::Neg(hn::Add(exponent, fraction)), hn::Set(d, 1e-12F));
        return hn::Mul(square, hn::ApproximateReciprocalSqrt(square));
    }
    // A function of the value that is nearly linear along an edge, for interpolation: the base-2 logarithm, to 0.01.
    static HWY_INLINE float along_edge(float value) {
        const auto bits = std::bit_cast<std::uint32_t>(std::max(value, 1e-8F));
        const float exponent = static_cast<float>(static_cast<int>(bits >> 23) - 127);
        const float m = std::bit_cast<float>((bits & 0x7FFFFFU) | 0x3F800000U);
        return exponent + (-0.33333333F * m + 2.0F) * m - 1.66666667F;
    }
};

} // namespace ramus::field::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
