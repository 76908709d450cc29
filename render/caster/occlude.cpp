#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/caster/occlude.cpp"
// clang-format off: foreach_target compiles this file once per instruction set and must come first.
#include <hwy/foreach_target.h>
// clang-format on
#include "render/caster/lanes-inl.h"
#include "render/caster/occlude.h"

#include <algorithm>
#include <cmath>

HWY_BEFORE_NAMESPACE();
namespace ramus::render::caster::HWY_NAMESPACE {

void DealTile(int x0, int y0, const View& view, const PictureArrays& picture) {
    const hn::CappedTag<float, kTile / 4> d;
    constexpr int kLanes = int(hn::MaxLanes(d));
    for (int y = y0; y < y0 + kTile && y < view.height; ++y) {
        for (int x = x0; x < x0 + kTile; x += 4 * kLanes) {
            hn::Vec<decltype(d)> v[4];
            hn::LoadInterleaved4(d, picture.depth + std::ptrdiff_t{y} * view.stride + x, v[0], v[1], v[2], v[3]);
            float* to = picture.dealt + y * picture.dealt_stride + x / 4;
            for (int k = 0; k < 4; ++k) hn::StoreU(v[k], d, to + k * picture.dealt_plane);
        }
    }
}

// Places of row y, four pixels apart from column x + k on.
struct Places {
    int x, k, y;
    V depth;
    V3 normal;
};

template <bool Flat>
HWY_INLINE V OcclusionOf(const View& view, const Taps& taps, const PictureArrays& picture, const Places& at) {
    const V zero = hn::Zero(D());
    // From the line of sight, mm at depth 1 when perspective.
    const V pixel = hn::MulAdd(hn::Iota(D(), 0), set(4.0F), set(static_cast<float>(at.x + at.k) + 0.5F));
    const V first_x = hn::Mul(hn::Sub(pixel, set(view.centre_x)), set(view.mm_a_pixel));
    const float first_y = (static_cast<float>(at.y) + 0.5F - view.centre_y) * view.mm_a_pixel;
    const V across = Flat ? first_x : hn::Mul(first_x, at.depth);
    const V up = Flat ? set(first_y) : hn::Mul(set(first_y), at.depth);
    const V reach = Flat ? set(view.reach_mm) : hn::Mul(set(view.reach_mm), at.depth);
    const V squared_reach = hn::Mul(reach, reach);
    const V bias = hn::Mul(set(0.02F), reach), softness = hn::Mul(set(0.01F), squared_reach);
    const V fall_off = hn::Div(set(0.25F), squared_reach);
    const auto& places = taps.of[at.y & 3][at.k];
    V sum = zero;
    for (int i = 0; i < taps.count; ++i) {
        const int dx = places.x[i], y = at.y + places.y[i], column = at.k + dx;
        if (y < 0 || y >= view.height) continue;
        const V tap = hn::LoadU(D(), picture.dealt + (column & 3) * picture.dealt_plane + y * picture.dealt_stride +
                                         at.x / 4 + (column >> 2));
        // Where there is nothing it is so far away that it weighs nothing.
        const V tap_x = hn::Add(first_x, set(static_cast<float>(dx) * view.mm_a_pixel));
        const V tap_y = set(first_y + static_cast<float>(places.y[i]) * view.mm_a_pixel);
        const V deeper = hn::Sub(tap, at.depth);
        const V3 v = Flat ? V3{hn::Sub(tap_x, across), hn::Sub(tap_y, up), deeper}
                          : V3{hn::MulSub(tap_x, tap, across), hn::MulSub(tap_y, tap, up), deeper};
        const V squared = dot(v, v);
        const V weight = hn::Max(zero, hn::NegMulAdd(squared, fall_off, set(1.0F)));
        const V over = hn::Max(zero, hn::Sub(dot(v, at.normal), bias));
        const V closeness = hn::ApproximateReciprocalSqrt(hn::Add(squared, softness));
        sum = hn::MulAdd(hn::Mul(weight, over), closeness, sum);
    }
    return clamp01(hn::Mul(set(2.4F / static_cast<float>(taps.count)), sum));
}

void OccludeTiles(const View& view, const Taps& taps, int x0, int y0, const PictureArrays& picture) {
    const D d;
    const DU du;
    constexpr int kWide = kOccludedTiles * kTile;
    static_assert(kWide >= 4 * kN);
    for (int y = y0; y < y0 + kTile && y < view.height; ++y) {
        for (int x = x0; x < x0 + kWide && x < view.width; x += 4 * kN) {
            const std::ptrdiff_t first = std::ptrdiff_t{y} * view.stride + x;
            const float* dealt = picture.dealt + y * picture.dealt_stride + x / 4;
            V depth[4], found[4];
            M any = hn::FirstN(d, 0), there[4];
            for (int k = 0; k < 4; ++k) {
                depth[k] = hn::LoadU(d, dealt + k * picture.dealt_plane);
                there[k] = hn::Lt(depth[k], set(0.5F * kNothing));
                any = hn::Or(any, there[k]);
            }
            if (hn::AllFalse(d, any)) continue; // their depth keeps them out of every mean
            VU normal[4];
            hn::LoadInterleaved4(du, picture.normal + first, normal[0], normal[1], normal[2], normal[3]);
            for (int k = 0; k < 4; ++k) {
                V3 n = unpacked_normal(normal[k]);
                n.z = hn::Neg(n.z); // depth is +z here
                const Places places{x, k, y, depth[k], n};
                const V occlusion = view.flat ? OcclusionOf<true>(view, taps, picture, places)
                                              : OcclusionOf<false>(view, taps, picture, places);
                found[k] = hn::IfThenElseZero(there[k], occlusion);
            }
            hn::StoreInterleaved4(found[0], found[1], found[2], found[3], d, picture.occlusion + first);
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
    const V nothing = set(0.5F * kNothing), zero = hn::Zero(d);
    const auto inverse_tolerance = [&](V depth) {
        const V reach = view.flat ? set(view.reach_mm) : hn::Mul(set(view.reach_mm), depth);
        return hn::Div(set(2.0F), reach);
    };
    constexpr int kRows = kTile + 6, kFirst = -3; // along rows
    alignas(64) float half[kRows * kTile];
    for (int i = 0; i < kRows; ++i) {
        const int y = y0 + kFirst + i;
        if (y < 0 || y >= view.height) continue;
        for (int x = x0; x < x0 + kTile && x < view.width; x += kN) {
            const float* depths = picture.depth + std::ptrdiff_t{y} * view.stride + x;
            const float* values = picture.occlusion + std::ptrdiff_t{y} * view.stride + x;
            const V depth = hn::LoadU(d, depths);
            V found = zero;
            if (!hn::AllFalse(d, hn::Lt(depth, nothing))) {
                const V inverse = inverse_tolerance(depth);
                Mean mean{zero, zero};
                for (int step = -3; step <= 3; ++step) // into the padding, at the picture's sides
                    mean.add(hn::LoadU(d, values + step), hn::LoadU(d, depths + step), depth, inverse,
                             set(Centred(step)));
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
                for (int step = -3; step <= 3; ++step) {
                    if (y + step < 0 || y + step >= view.height) continue;
                    mean.add(hn::Load(d, half + (y + step - y0 - kFirst) * kTile + x - x0),
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

HWY_EXPORT(DealTile);
HWY_EXPORT(OccludeTiles);
HWY_EXPORT(SmoothTile);

Taps taps_of(const View& view) {
    Taps taps{};
    taps.count = std::min(view.taps, Taps::kMost);
    constexpr double kTurn = 0.39269908, kGolden = 2.39996323; // a sixteenth of the way around; the golden angle
    constexpr int kFine[4] = {0, 2, 1, 3};
    for (int row = 0; row < 4; ++row)
        for (int column = 0; column < 4; ++column)
            for (int i = 0; i < taps.count; ++i) {
                const double angle = kTurn * (4 * ((row + column) & 3) + kFine[row]) + kGolden * i;
                const double fraction = (i + 0.5) / taps.count;
                // Denser towards the centre: contacts count more than far neighbours.
                const double far = double{view.reach_pixels} * fraction * std::sqrt(fraction);
                taps.of[row][column].x[i] = static_cast<std::int16_t>(std::lround(far * std::cos(angle)));
                taps.of[row][column].y[i] = static_cast<std::int16_t>(std::lround(far * std::sin(angle)));
            }
    return taps;
}

void deal_tile(int x, int y, const View& view, const PictureArrays& picture) {
    HWY_DYNAMIC_DISPATCH(DealTile)(x, y, view, picture);
}
void occlude_tiles(const View& view, const Taps& taps, int x, int y, const PictureArrays& picture) {
    HWY_DYNAMIC_DISPATCH(OccludeTiles)(view, taps, x, y, picture);
}
void smooth_tile(const View& view, int x, int y, const PictureArrays& picture) {
    HWY_DYNAMIC_DISPATCH(SmoothTile)(view, x, y, picture);
}

} // namespace ramus::render::caster
#endif
