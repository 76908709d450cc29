#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/caster/shadow.cpp"
// clang-format off: foreach_target compiles this file once per instruction set and must come first.
#include <hwy/foreach_target.h>
// clang-format on
#include "render/caster/glsl-inl.h"
#include "render/caster/stages.h"

#include <cmath>

HWY_BEFORE_NAMESPACE();
namespace ramus::render::caster::HWY_NAMESPACE {

// Deriving from the block makes its uniforms visible by name, as globals are in GLSL.
class ShadowOfPixels : ViewBlock {
public:
    HWY_INLINE ShadowOfPixels(const View& view, const float* depths)
        : ViewBlock(view.block), view_(view), depths_(depths) {}

#define INLINE HWY_INLINE
// In the order in which they need each other.
// clang-format off
#include "shaders/look/position.glsl"
#include "shaders/look/shadow.glsl"
// clang-format on
#undef INLINE

private:
    // Depth of the nearest pixel of the picture.
    HWY_INLINE Float opaque_depth_at(Vec2 pixel) const {
        const auto held = [](Float at, int count) {
            return hn::Min(hn::Max(hn::ConvertTo(DI(), at.v), hn::Zero(DI())), hn::Set(DI(), count - 1));
        };
        return gather(depths_,
                      index_of(held(pixel.y, view_.height), hn::Set(DI(), view_.stride), held(pixel.x, view_.width)));
    }

    const View& view_;
    const float* depths_;
};

// Every fourth pixel of a row has the same rays.
void shadow_lanes(const View& view, const ShadowRays& rays, int x0, int y0, const PictureArrays& picture) {
    const D d;
    const DU du;
    ShadowOfPixels formulas(view, picture.depth);
    for (int y = y0; y < y0 + kTile && y < view.height; ++y) {
        for (int x = x0; x < x0 + kOccludedTiles * kTile && x < view.width; x += 4 * kN) {
            const std::ptrdiff_t first = std::ptrdiff_t{y} * view.stride + x;
            const float* dealt = picture.depth_planes + y * picture.plane_stride + x / 4;
            V found[4];
            VU normal[4];
            hn::LoadInterleaved4(du, picture.normal + first, normal[0], normal[1], normal[2], normal[3]);
            for (int k = 0; k < 4; ++k) {
                const Float depth = hn::LoadU(d, dealt + k * picture.plane_size);
                const Mask there = depth < 0.5F * kNothing;
                found[k] = hn::Zero(d); // the depth of empty pixels gives them no weight
                if (!any(there)) continue;
                const Float column = mad(hn::Iota(d, 0), 4.0F, static_cast<float>(x + k) + 0.5F);
                const Vec2 pixel(column, static_cast<float>(y) + 0.5F);
                const Vec3 position = formulas.eye_position(pixel, select(there, depth, view.block.depth_range.y));
                found[k] = formulas.shadowed(position, unpacked_normal(normal[k]), rays.of[y & 3][k]).v;
            }
            hn::StoreInterleaved4(found[0], found[1], found[2], found[3], d, picture.key.rough + first);
        }
    }
}

} // namespace ramus::render::caster::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace ramus::render::caster {

HWY_EXPORT(shadow_lanes);

namespace {

struct RayFormulas {
    static float sqrt(float x) { return std::sqrt(x); }
    static float cos(float x) { return std::cos(x); }
    static float sin(float x) { return std::sin(x); }
    static float floor(float x) { return std::floor(x); }
// In the order in which they need each other.
// clang-format off
#include "shaders/look/taps.glsl"
#include "shaders/look/shadow_ray.glsl"
    // clang-format on
};

} // namespace

ShadowRays shadow_rays() {
    ShadowRays rays{};
    RayFormulas formulas;
    for (int row = 0; row < 4; ++row)
        for (int column = 0; column < 4; ++column) rays.of[row][column] = formulas.shadow_ray(column, row, 0.0F);
    return rays;
}

void shadow_tiles(const View& view, const ShadowRays& rays, int x, int y, const PictureArrays& picture) {
    HWY_DYNAMIC_DISPATCH(shadow_lanes)(view, rays, x, y, picture);
}

} // namespace ramus::render::caster
#endif
