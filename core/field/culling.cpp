#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/field/culling.cpp"
// clang-format off: foreach_target compiles this file once per instruction set and must come first.
#include <hwy/foreach_target.h>
// clang-format on
#include "core/field/culling.h"
#include "core/field/kernel-inl.h"

#include <algorithm>
#include <cmath>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace ramus::field::HWY_NAMESPACE {

// One lane per child, in one or two vectors.
using D8 = hn::CappedTag<float, kChildren>;
using V8 = hn::Vec<D8>;

// The kernel of one segment over balls: upper and lower bounds are added where `reaches`.
HWY_INLINE void add_bounds(D8 d, const CullingSegment& s, V8 off_axis, V8 t, V8 beyond, V8 ball, V8 fine, V8 coarse,
                           hn::Mask<D8> reaches, V8& lower, V8& upper) {
    const V8 zero = hn::Zero(d);
    const V8 limit = hn::Set(d, 40.0F);
    const V8 half = hn::Set(d, 0.5F);
    const V8 length = hn::Set(d, s.length);
    const V8 middle = hn::Mul(half, length);
    const V8 t_low = hn::Sub(t, ball);
    const V8 t_high = hn::Add(t, ball);
    // The end filter is highest nearest to the segment's middle, lowest farthest from it; erf grows with its argument,
    // so each term takes the radius that bounds it.
    const V8 q_min = hn::Mul(hn::Max(hn::Sub(off_axis, ball), zero), coarse);
    const V8 t_best = hn::Max(hn::Min(middle, t_high), t_low);
    const auto term_upper = [&](V8 v) {
        return error_function(d, hn::Mul(v, hn::IfThenElse(hn::Ge(v, zero), fine, coarse)));
    };
    const V8 filter_upper = hn::Mul(half, hn::Add(term_upper(t_best), term_upper(hn::Sub(length, t_best))));
    const V8 gauss_upper = exp_negative(d, hn::Min(hn::Mul(q_min, q_min), limit));
    upper = hn::Add(upper, hn::IfThenElseZero(reaches, hn::Mul(gauss_upper, filter_upper)));

    const V8 q_max = hn::Mul(hn::Add(off_axis, ball), fine);
    const V8 e_max = hn::Mul(hn::Add(hn::Abs(beyond), ball), fine);
    const V8 rho_max = hn::MulAdd(e_max, e_max, hn::Mul(q_max, q_max));
    if (hn::AllFalse(d, hn::Lt(rho_max, hn::Set(d, static_cast<float>(kFadeEnd))))) return;
    const V8 t_worst = hn::IfThenElse(hn::Gt(t, middle), t_high, t_low);
    const auto term_lower = [&](V8 v) {
        return error_function(d, hn::Mul(v, hn::IfThenElse(hn::Ge(v, zero), coarse, fine)));
    };
    const V8 filter_lower =
        hn::Max(zero, hn::Mul(half, hn::Add(term_lower(t_worst), term_lower(hn::Sub(length, t_worst)))));
    const V8 gauss_lower = hn::Mul(exp_negative(d, hn::Min(hn::Mul(q_max, q_max), limit)), fade(d, rho_max));
    lower = hn::Add(lower, hn::IfThenElseZero(reaches, hn::Mul(gauss_lower, filter_lower)));
}

void CullChildren(const Kernel& kernel, const CullingSegment* segments, const std::uint32_t* list, std::size_t count,
                  glm::vec3 middle, float child_side, float ball_radius, std::uint8_t* HWY_RESTRICT reaching,
                  ChildBounds& bounds) {
    const D8 d;
    const std::size_t lanes = hn::Lanes(d);
    const V8 sqrt_w = hn::Set(d, static_cast<float>(kernel.sqrt_w));
    const V8 ball = hn::Set(d, ball_radius);
    const V8 zero = hn::Zero(d);
    alignas(32) float x[kChildren], y[kChildren], z[kChildren];
    for (int c = 0; c < kChildren; ++c) {
        x[c] = middle.x + ((c & 1) != 0 ? 0.5F : -0.5F) * child_side;
        y[c] = middle.y + ((c & 2) != 0 ? 0.5F : -0.5F) * child_side;
        z[c] = middle.z + ((c & 4) != 0 ? 0.5F : -0.5F) * child_side;
    }
    for (std::size_t m = 0; m < count; ++m) reaching[m] = 0;
    for (std::size_t first = 0; first < kChildren; first += lanes) {
        const V8 cx = hn::Load(d, x + first);
        const V8 cy = hn::Load(d, y + first);
        const V8 cz = hn::Load(d, z + first);
        V8 lower = zero;
        V8 upper = zero;
        for (std::size_t m = 0; m < count; ++m) {
            const CullingSegment& s = segments[list[m]];
            const V8 px = hn::Sub(cx, hn::Set(d, s.ax));
            const V8 py = hn::Sub(cy, hn::Set(d, s.ay));
            const V8 pz = hn::Sub(cz, hn::Set(d, s.az));
            const V8 ux = hn::Set(d, s.ux);
            const V8 uy = hn::Set(d, s.uy);
            const V8 uz = hn::Set(d, s.uz);
            const V8 length = hn::Set(d, s.length);
            const V8 t = hn::MulAdd(pz, uz, hn::MulAdd(py, uy, hn::Mul(px, ux)));
            const V8 qx = hn::NegMulAdd(t, ux, px);
            const V8 qy = hn::NegMulAdd(t, uy, py);
            const V8 qz = hn::NegMulAdd(t, uz, pz);
            const V8 off_axis = hn::Sqrt(hn::MulAdd(qz, qz, hn::MulAdd(qy, qy, hn::Mul(qx, qx))));
            const V8 beyond = hn::Sub(t, hn::Max(hn::Min(t, length), zero));
            const V8 distance = hn::Sqrt(hn::MulAdd(beyond, beyond, hn::Mul(off_axis, off_axis)));
            // Radii that any point of the ball may see.
            const V8 radius = hn::Set(d, s.radius);
            const V8 slope = hn::Set(d, s.slope);
            const V8 r1 = hn::MulAdd(slope, hn::Max(hn::Min(hn::Sub(t, ball), length), zero), radius);
            const V8 r2 = hn::MulAdd(slope, hn::Max(hn::Min(hn::Add(t, ball), length), zero), radius);
            const V8 coarse = hn::Div(sqrt_w, hn::Max(r1, r2));
            const V8 nearest = hn::Mul(hn::Max(hn::Sub(distance, ball), zero), coarse);
            // The margin covers the rounding of single precision far from the origin.
            const auto reaches = hn::Lt(hn::Mul(nearest, nearest), hn::Set(d, static_cast<float>(kFadeEnd * 1.001)));
            HWY_ALIGN std::uint8_t bits[8] = {};
            hn::StoreMaskBits(d, reaches, bits);
            const unsigned reached = bits[0] & ((1U << lanes) - 1);
            if (reached == 0) continue;
            reaching[m] = static_cast<std::uint8_t>(reaching[m] | reached << first);
            add_bounds(d, s, off_axis, t, beyond, ball, hn::Div(sqrt_w, hn::Min(r1, r2)), coarse, reaches, lower,
                       upper);
        }
        hn::Store(lower, d, bounds.lower.data() + first);
        hn::Store(upper, d, bounds.upper.data() + first);
    }
}

} // namespace ramus::field::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace ramus::field {

HWY_EXPORT(CullChildren);

CullingSegments::CullingSegments(const ConvolutionField& field) : origin(0.5 * (field.lower() + field.upper())) {
    const SegmentArrays& s = field.segments();
    segments.reserve(s.size());
    for (std::size_t i = 0; i < s.size(); ++i)
        segments.push_back({static_cast<float>(s.ax[i] - origin.x), static_cast<float>(s.ay[i] - origin.y),
                            static_cast<float>(s.az[i] - origin.z), s.ux[i], s.uy[i], s.uz[i], s.length[i], s.radius[i],
                            s.slope[i]});
}

ChildBounds cull_children(const ConvolutionField& field, const CullingSegments& culling,
                          std::span<const std::uint32_t> list, glm::vec3 middle, float child_side,
                          std::span<std::uint8_t> reaching) {
    ChildBounds bounds;
    // Positions in single precision relative to the origin: widen the balls by what they may be off.
    const float farthest = std::max({std::abs(middle.x), std::abs(middle.y), std::abs(middle.z)}) + child_side;
    constexpr float kSqrt3Half = 0.8660254F;
    const float ball = kSqrt3Half * child_side * 1.0001F + 6e-7F * farthest;
    HWY_DYNAMIC_DISPATCH(CullChildren)
    (field.kernel(), culling.segments.data(), list.data(), list.size(), middle, child_side, ball, reaching.data(),
     bounds);
    return bounds;
}

} // namespace ramus::field
#endif
