#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/caster/occlude.cpp"
// clang-format off: foreach_target compiles this file once per instruction set and must come first.
#include <hwy/foreach_target.h>
// clang-format on
#include "render/caster/lanes-inl.h"
#include "render/caster/occlude.h"

HWY_BEFORE_NAMESPACE();
namespace ramus::render::caster::HWY_NAMESPACE {

// Of every second pixel in every second row: what smooths it fills in the others.
void OccludeTile(const View& view, int x0, int y0, const PictureArrays& picture) {
    const D d;
    const DI di;
    const V zero = hn::Zero(d), nothing = set(0.5F * kNothing);
    const VI last_x = hn::Set(di, view.width - 1), last_y = hn::Set(di, view.height - 1), none = hn::Zero(di);
    const VI stride = hn::Set(di, view.stride);
    alignas(64) float found[kN];
    for (int y = y0; y < y0 + kTile && y < view.height; y += 2) {
        for (int x = x0; x < x0 + kTile && x < view.width; x += 2 * kN) {
            const std::size_t at = std::size_t(y) * std::size_t(view.stride) + std::size_t(x);
            const VI column = hn::Add(hn::Set(di, x), hn::ShiftLeft<1>(hn::Iota(di, 0)));
            const VI index = hn::Add(hn::Set(di, static_cast<std::int32_t>(at)), hn::ShiftLeft<1>(hn::Iota(di, 0)));
            const V depth = gather(picture.depth, index);
            const M there = hn::Lt(depth, nothing);
            if (hn::AllFalse(d, there)) continue; // their depth keeps them out of every mean
            const V px = hn::Add(hn::ConvertTo(d, column), set(0.5F)), py = set(static_cast<float>(y) + 0.5F);
            const V3 centre = eye_position(view, px, py, depth);
            V3 n = unpacked_normal(gather(picture.normal, index));
            n.z = hn::Neg(n.z); // depth is +z here
            const V reach = view.flat ? set(view.reach_mm) : hn::Mul(set(view.reach_mm), depth);
            const V squared_reach = hn::Mul(reach, reach);
            const V bias = hn::Mul(set(0.02F), reach), softness = hn::Mul(set(0.01F), squared_reach);
            const V fall_off = hn::Div(set(0.25F), squared_reach);
            const V turn = hn::Mul(set(6.2831853F), noise(px, py));
            V across = hn::Cos(d, turn), up = hn::Sin(d, turn), sum = zero;
            for (int i = 0; i < view.taps; ++i) {
                const float fraction = (static_cast<float>(i) + 0.5F) / static_cast<float>(view.taps);
                // Denser towards the centre: contacts count more than far neighbours.
                const V far = set(view.reach_pixels * fraction * __builtin_sqrtf(fraction));
                VI tx = hn::Add(column, hn::NearestInt(hn::Mul(far, across)));
                VI ty = hn::Add(hn::Set(di, y), hn::NearestInt(hn::Mul(far, up)));
                tx = hn::Min(hn::Max(tx, none), last_x);
                ty = hn::Min(hn::Max(ty, none), last_y);
                // By the golden angle.
                const V turned = hn::MulAdd(set(-0.73736887F), across, hn::Mul(set(-0.67549029F), up));
                up = hn::MulAdd(set(0.67549029F), across, hn::Mul(set(-0.73736887F), up));
                across = turned;
                const V tap = gather(picture.depth, index_of(ty, stride, tx));
                const M hit = hn::Lt(tap, nothing);
                if (hn::AllFalse(d, hit)) continue;
                const V half = set(0.5F);
                const V3 v =
                    eye_position(view, hn::Add(hn::ConvertTo(d, tx), half), hn::Add(hn::ConvertTo(d, ty), half), tap) -
                    centre;
                const V squared = dot(v, v);
                const V weight = hn::Max(zero, hn::NegMulAdd(squared, fall_off, set(1.0F)));
                const V over = hn::Max(zero, hn::Sub(dot(v, n), bias));
                sum = hn::Add(sum, hn::IfThenElseZero(
                                       hit, hn::Mul(hn::Mul(weight, over), inverse_root(hn::Add(squared, softness)))));
            }
            const V occlusion = clamp01(hn::Mul(set(2.4F / static_cast<float>(view.taps)), sum));
            hn::Store(occlusion, d, found);
            for (int k = 0; k < kN; ++k) picture.occlusion[at + 2 * std::size_t(k)] = found[k];
        }
    }
}

// How much a value four pixels' steps along counts: the more the nearer, and only if it is about as deep.
struct Mean {
    V sum, weights; // from zero
    HWY_INLINE void add(V value, V depth_there, V depth, V inverse_tolerance, V centred) {
        const V difference = hn::Abs(hn::Sub(depth_there, depth));
        const V weight =
            hn::Mul(centred, hn::Max(hn::Zero(D()), hn::NegMulAdd(difference, inverse_tolerance, set(1.0F))));
        sum = hn::MulAdd(weight, value, sum);
        weights = hn::Add(weights, weight);
    }
    [[nodiscard]] HWY_INLINE V value() const { return hn::Div(sum, hn::Max(weights, set(1e-6F))); }
};

constexpr float Centred(int step) { return static_cast<float>(4 - (step < 0 ? -step : step)); }

void SmoothTile(const View& view, int x0, int y0, const PictureArrays& picture) {
    const D d;
    const DI di;
    const V nothing = set(0.5F * kNothing), zero = hn::Zero(d);
    const auto inverse_tolerance = [&](V depth) {
        const V reach = view.flat ? set(view.reach_mm) : hn::Mul(set(view.reach_mm), depth);
        return hn::Div(set(2.0F), reach);
    };
    // Along rows: of every second row, for all pixels of it, from every second one.
    constexpr int kRows = kTile / 2 + 3, kFirst = -2;
    alignas(64) float half[kRows * kTile];
    for (int i = 0; i < kRows; ++i) {
        const int y = y0 + kFirst + 2 * i;
        if (y < 0 || y >= view.height) continue;
        for (int x = x0; x < x0 + kTile && x < view.width; x += kN) {
            const float* depths = picture.depth + std::ptrdiff_t{y} * view.stride + x;
            const float* values = picture.occlusion + std::ptrdiff_t{y} * view.stride + x;
            const V depth = hn::LoadU(d, depths);
            V found = zero;
            if (!hn::AllFalse(d, hn::Lt(depth, nothing))) {
                const V inverse = inverse_tolerance(depth);
                const VI column = hn::Iota(di, x);
                Mean mean{zero, zero};
                for (int step = -3; step <= 3; ++step) { // into the padding, at the picture's sides
                    const auto odd = hn::Ne(hn::And(hn::Add(column, hn::Set(di, step)), hn::Set(di, 1)), hn::Zero(di));
                    mean.add(hn::LoadU(d, values + step), hn::LoadU(d, depths + step), depth, inverse,
                             hn::IfThenZeroElse(hn::RebindMask(d, odd), set(Centred(step))));
                }
                found = mean.value();
            }
            hn::Store(found, d, half + i * kTile + x - x0);
        }
    }
    for (int y = y0; y < y0 + kTile && y < view.height; ++y) {
        for (int x = x0; x < x0 + kTile && x < view.width; x += kN) {
            const float* depths = picture.depth + std::ptrdiff_t{y} * view.stride + x;
            const V depth = hn::LoadU(d, depths);
            const M there = hn::Lt(depth, nothing);
            V found = zero;
            if (!hn::AllFalse(d, there)) {
                const V inverse = inverse_tolerance(depth);
                Mean mean{zero, zero};
                for (int step = (y & 1) == 0 ? -2 : -3; step <= 3; step += 2) {
                    if (y + step < 0 || y + step >= view.height) continue;
                    mean.add(hn::Load(d, half + (y + step - y0 - kFirst) / 2 * kTile + x - x0),
                             hn::LoadU(d, depths + std::ptrdiff_t{step} * view.stride), depth, inverse,
                             set(Centred(step)));
                }
                found = hn::IfThenElseZero(there, mean.value());
            }
            hn::StoreU(found, d, picture.smooth + std::ptrdiff_t{y} * view.stride + x);
        }
    }
}

} // namespace ramus::render::caster::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace ramus::render::caster {

HWY_EXPORT(OccludeTile);
HWY_EXPORT(SmoothTile);

void occlude_tile(const View& view, int x, int y, const PictureArrays& picture) {
    HWY_DYNAMIC_DISPATCH(OccludeTile)(view, x, y, picture);
}
void smooth_tile(const View& view, int x, int y, const PictureArrays& picture) {
    HWY_DYNAMIC_DISPATCH(SmoothTile)(view, x, y, picture);
}

} // namespace ramus::render::caster
#endif
