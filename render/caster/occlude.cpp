#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/caster/occlude.cpp"
// clang-format off: foreach_target compiles this file once per instruction set and must come first.
#include <hwy/foreach_target.h>
// clang-format on
#include "render/caster/glsl-inl.h"
#include "render/caster/stages.h"

#include <algorithm>
#include <cmath>

HWY_BEFORE_NAMESPACE();
namespace ramus::render::caster::HWY_NAMESPACE {

#define INLINE HWY_INLINE
struct OcclusionOfPixels : ViewBlock {
#include "shaders/look/occlusion.glsl"
};
#undef INLINE
using OcclusionScale = OcclusionOfPixels::OcclusionScale;

void split_depth_lanes(int x0, int y0, const View& view, const PictureArrays& picture) {
    const hn::CappedTag<float, kTile / 4> d;
    constexpr int kLanes = int(hn::MaxLanes(d));
    for (int y = y0; y < y0 + kTile && y < view.height; ++y) {
        for (int x = x0; x < x0 + kTile; x += 4 * kLanes) {
            hn::Vec<decltype(d)> v[4];
            hn::LoadInterleaved4(d, picture.depth + std::ptrdiff_t{y} * view.stride + x, v[0], v[1], v[2], v[3]);
            float* to = picture.depth_planes + y * picture.plane_stride + x / 4;
            for (int k = 0; k < 4; ++k) hn::StoreU(v[k], d, to + k * picture.plane_size);
        }
    }
}

// Reads pixels of row y, four columns apart, starting at column x + k.
struct FarPixels {
    int x, k, y;
    Float depth;
    Vec3 normal; // with depth as +z
};

template <bool Flat>
HWY_INLINE Float occlusion_of(const View& view, const Taps& taps, const PictureArrays& picture, const FarPixels& at) {
    OcclusionOfPixels formulas{view.block};
    // From the line of sight, mm at depth 1 when perspective.
    const Float first_x =
        (mad(hn::Iota(D(), 0), 4.0F, static_cast<float>(at.x + at.k) + 0.5F) - view.centre_x) * view.mm_a_pixel;
    const float first_y = (static_cast<float>(at.y) + 0.5F - view.centre_y) * view.mm_a_pixel;
    const Float across = Flat ? first_x : first_x * at.depth, up = Flat ? Float(first_y) : first_y * at.depth;
    const OcclusionScale scale = formulas.occlusion_scale(at.depth);
    const auto& offsets = taps.of[at.y & 3][at.k];
    Float sum = 0.0F;
    for (int i = 0; i < taps.count; ++i) {
        const int dx = offsets.x[i], y = at.y + offsets.y[i], column = at.k + dx;
        if (y < 0 || y >= view.height) continue;
        // Empty pixels have such a large depth that their weight is 0.
        const Float tap = hn::LoadU(D(), picture.depth_planes + (column & 3) * picture.plane_size +
                                             y * picture.plane_stride + at.x / 4 + (column >> 2));
        const Float tap_x = first_x + static_cast<float>(dx) * view.mm_a_pixel;
        const Float tap_y = first_y + static_cast<float>(offsets.y[i]) * view.mm_a_pixel;
        const Float deeper = tap - at.depth;
        const Vec3 way = Flat ? Vec3(tap_x - across, tap_y - up, deeper)
                              : Vec3(mad(tap_x, tap, -across), mad(tap_y, tap, -up), deeper);
        sum = formulas.with_tap(sum, way, at.normal, scale);
    }
    return formulas.occlusion_of_sum(sum, static_cast<float>(taps.count));
}

void occlude_lanes(const View& view, const Taps& taps, int x0, int y0, const PictureArrays& picture) {
    const D d;
    const DU du;
    constexpr int kWide = kOccludedTiles * kTile;
    static_assert(kWide >= 4 * kN);
    for (int y = y0; y < y0 + kTile && y < view.height; ++y) {
        for (int x = x0; x < x0 + kWide && x < view.width; x += 4 * kN) {
            const std::ptrdiff_t first = std::ptrdiff_t{y} * view.stride + x;
            const float* dealt = picture.depth_planes + y * picture.plane_stride + x / 4;
            V depth[4], found[4];
            M any = hn::FirstN(d, 0), there[4];
            for (int k = 0; k < 4; ++k) {
                depth[k] = hn::LoadU(d, dealt + k * picture.plane_size);
                there[k] = hn::Lt(depth[k], set(0.5F * kNothing));
                any = hn::Or(any, there[k]);
            }
            if (hn::AllFalse(d, any)) continue; // their depth gives them no weight
            VU normal[4];
            hn::LoadInterleaved4(du, picture.normal + first, normal[0], normal[1], normal[2], normal[3]);
            for (int k = 0; k < 4; ++k) {
                const Vec3 n = unpacked_normal(normal[k]);
                const FarPixels pixels{x, k, y, depth[k], {n.x, n.y, -n.z}};
                const Float occlusion = view.flat ? occlusion_of<true>(view, taps, picture, pixels)
                                                  : occlusion_of<false>(view, taps, picture, pixels);
                found[k] = hn::IfThenElseZero(there[k], occlusion.v);
            }
            hn::StoreInterleaved4(found[0], found[1], found[2], found[3], d, picture.sky.rough + first);
        }
    }
}

constexpr int kBlurReach = 3; // pixels
constexpr int kBlurRows = kTile + 2 * kBlurReach;

// Means of up to kBlurReach steps around kN pixels. `depth_stride`, `value_stride`: distance of steps in the arrays.
// Only steps from `first` to `last` count.
HWY_INLINE V blurred(OcclusionOfPixels& formulas, const float* depths, std::ptrdiff_t depth_stride, const float* values,
                     std::ptrdiff_t value_stride, int first, int last) {
    const D d;
    const Float depth = hn::LoadU(d, depths);
    const Mask there = depth < 0.5F * kNothing;
    if (!any(there)) return hn::Zero(d);
    const Float per_tolerance = formulas.blur_tolerance_inverse(depth);
    Float sum = 0.0F, weights = 0.0F;
    for (int step = first; step <= last; ++step) {
        const Float deeper = Float(hn::LoadU(d, depths + step * depth_stride)) - depth;
        const Float weight = formulas.blur_weight(step, deeper, per_tolerance);
        sum = mad(weight, hn::LoadU(d, values + step * value_stride), sum);
        weights = weights + weight;
    }
    return hn::IfThenElseZero(there.m, (sum / max(weights, 1e-6F)).v);
}

// Blurs along rows, including the rows around the tile that the second blur needs, then across them.
void smooth_lanes(const View& view, int x0, int y0, const float* picture_depths, const PictureArrays::Taken& taken) {
    const D d;
    OcclusionOfPixels formulas{view.block};
    alignas(64) float half[kBlurRows * kTile];
    const auto for_rows = [&](int beyond, const auto& call) { // call(index in the picture, index in `half`, row)
        for (int y = y0 - beyond; y < y0 + kTile + beyond; ++y)
            for (int x = x0; x < x0 + kTile && x < view.width && y >= 0 && y < view.height; x += kN)
                call(std::ptrdiff_t{y} * view.stride + x, (y - y0 + kBlurReach) * kTile + x - x0, y);
    };
    for_rows(kBlurReach, [&](std::ptrdiff_t at, int in_half, int) { // into the padding, at the picture's sides
        const float *depths = picture_depths + at, *values = taken.rough + at;
        hn::Store(blurred(formulas, depths, 1, values, 1, -kBlurReach, kBlurReach), d, half + in_half);
    });
    for_rows(0, [&](std::ptrdiff_t at, int in_half, int y) {
        const int first = y < kBlurReach ? -y : -kBlurReach, above = view.height - 1 - y;
        const float* depths = picture_depths + at;
        hn::StoreU(blurred(formulas, depths, view.stride, half + in_half, kTile, first,
                           above < kBlurReach ? above : kBlurReach),
                   d, taken.smooth + at);
    });
}

} // namespace ramus::render::caster::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace ramus::render::caster {

HWY_EXPORT(split_depth_lanes);
HWY_EXPORT(occlude_lanes);
HWY_EXPORT(smooth_lanes);

namespace {

struct TapFormulas {
    static float sqrt(float x) { return std::sqrt(x); }
#include "shaders/look/taps.glsl"
};

} // namespace

Taps taps_of(const View& view) {
    Taps taps{};
    TapFormulas formulas;
    taps.count = std::min(view.taps, Taps::kMost);
    constexpr double kGolden = 2.39996323; // angle
    for (int row = 0; row < 4; ++row)
        for (int column = 0; column < 4; ++column)
            for (int i = 0; i < taps.count; ++i) {
                const double angle = double{formulas.first_turn(column, row)} + kGolden * i;
                const double far = double{view.block.depth_range.z} * double{formulas.tap_distance(i, taps.count)};
                taps.of[row][column].x[i] = static_cast<std::int16_t>(std::lround(far * std::cos(angle)));
                taps.of[row][column].y[i] = static_cast<std::int16_t>(std::lround(far * std::sin(angle)));
            }
    return taps;
}

void split_depths(int x, int y, const View& view, const PictureArrays& picture) {
    HWY_DYNAMIC_DISPATCH(split_depth_lanes)(x, y, view, picture);
}
void occlude_tiles(const View& view, const Taps& taps, int x, int y, const PictureArrays& picture) {
    HWY_DYNAMIC_DISPATCH(occlude_lanes)(view, taps, x, y, picture);
}
void smooth_tile(const View& view, int x, int y, const float* depths, const PictureArrays::Taken& taken) {
    HWY_DYNAMIC_DISPATCH(smooth_lanes)(view, x, y, depths, taken);
}

} // namespace ramus::render::caster
#endif
