// Compiles the formulas of shaders/look for vectors of pixels, with the uniforms and the arrays that replace textures.
// Included once per instruction set.
#if defined(RAMUS_CASTER_LOOK_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef RAMUS_CASTER_LOOK_INL_H
#undef RAMUS_CASTER_LOOK_INL_H
#else
#define RAMUS_CASTER_LOOK_INL_H
#endif

#include "render/caster/glsl-inl.h"
#include "render/scene/record_flags.h"

HWY_BEFORE_NAMESPACE();
namespace ramus::render::caster::HWY_NAMESPACE {

using namespace record;

// Deriving from Uniforms makes them visible by name, as globals are in GLSL. All variants of the shaders are compiled
// in; uniforms select what is on.
class LookOfPixels : Uniforms {
public:
    HWY_INLINE LookOfPixels(const Shading& shading, const PictureArrays& arrays)
        : Uniforms(shading.uniforms), shading_(shading), arrays_(arrays) {}

#define INLINE HWY_INLINE
#define ANY(mask) any(mask)
#define SCALE
#define MARGINS
#define CUTS
#define CHROMADEPTH
#define CONTOURS
#define HALOS
#define SHADOWS
// In the order of their dependencies.
// clang-format off
#include "shaders/look/point.glsl"
#include "shaders/look/position.glsl"
#include "shaders/look/srgb.glsl"
#include "shaders/look/colour.glsl"
#include "shaders/look/material.glsl"
#include "shaders/look/light.glsl"
#include "shaders/look/cues.glsl"
#include "shaders/look/glass.glsl"
#include "shaders/look/outline.glsl"
// clang-format on
#undef INLINE
#undef ANY
#undef SCALE
#undef MARGINS
#undef CUTS
#undef CHROMADEPTH
#undef CONTOURS
#undef HALOS
#undef SHADOWS

    // Linear colour and opacity (negative: lines). Arbitrary but valid for lanes that show neither lesions nor context.
    HWY_INLINE Vec4 shape_look(Uint id) const {
        const DU du;
        const VU number = hn::Sub(hn::And(id.v, hn::Set(du, kNumberBits)), hn::Set(du, 1U));
        const VU lesion = hn::IfThenZeroElse(hn::RebindMask(du, any_of(id.v, kContext)), hn::Set(du, 1U));
        const VU index = hn::Add(hn::ShiftLeft<1>(number), lesion);
        const VI first =
            hn::BitCast(DI(), hn::ShiftLeft<2>(hn::IfThenElseZero(hn::RebindMask(du, any_of(id.v, kSolid)), index)));
        const auto channel = [&](int c) { return Float(gather(shading_.shapes + c, first)); };
        return {channel(0), channel(1), channel(2), channel(3)};
    }
    HWY_INLINE bool shadows() const { return more.w > 0.0F; }

private:
    // Index of the nearest pixel in the picture.
    HWY_INLINE VI index_at(Vec2 pixel) const {
        const auto held = [](Float at, int count) {
            return hn::Min(hn::Max(hn::ConvertTo(DI(), at.v), hn::Zero(DI())), hn::Set(DI(), count - 1));
        };
        return index_of(held(pixel.y, shading_.height), hn::Set(DI(), shading_.stride), held(pixel.x, shading_.width));
    }
    HWY_INLINE Float opaque_depth_at(Vec2 pixel) const { return gather(arrays_.depth, index_at(pixel)); }
    HWY_INLINE Vec2 taken_at(Vec2 pixel) const {
        const VI at = index_at(pixel);
        return {gather(arrays_.sky.smooth, at), gather(arrays_.key.smooth, at)};
    }
    HWY_INLINE Mask selected_at(Vec2 pixel) const {
        const DU du;
        const VU id = gather(arrays_.id, index_at(pixel));
        const auto branch = hn::And(hn::Ne(id, hn::Zero(du)), hn::Eq(hn::And(id, hn::Set(du, kSolid)), hn::Zero(du)));
        const VU index = hn::IfThenElseZero(branch, hn::Sub(id, hn::Set(du, 1U)));
        const VU word = gather(shading_.branches + 1, hn::BitCast(DI(), hn::ShiftLeft<1>(index)));
        return {hn::And(mask(branch), any_of(hn::ShiftRight<16>(word), kSelected))};
    }
    HWY_INLINE Vec2 outline_step(int i) const { return {shading_.outline_ring[i].x, shading_.outline_ring[i].y}; }
    HWY_INLINE Vec2 halo_step(int i) const { return {shading_.halo_ring[i].x, shading_.halo_ring[i].y}; }

    HWY_INLINE Float value_on_scale(const SurfacePoint& p) const { return p.value; }
    HWY_INLINE Float root_distance(const SurfacePoint& p) const { return p.value; }
    HWY_INLINE const vec4& cut_texel(int i) const { return shading_.cuts[i]; }
    HWY_INLINE const vec4& lesion_sphere(int i) const { return shading_.lesions[i]; }

    // sRGB. The ends of the scale get the first and the last colour, as in the shaders.
    HWY_INLINE Vec3 ramp_colour(Float along) const {
        const auto steps = static_cast<float>(shading_.ramp_steps);
        const Float at = along * (steps - 1.0F);
        const Float low = min(hn::Floor(at.v), steps > 1.0F ? steps - 2.0F : 0.0F), t = at - low;
        const VI index = hn::Mul(hn::NearestInt(low.v), hn::Set(DI(), 3));
        const int next = shading_.ramp_steps > 1 ? 3 : 0;
        const auto channel = [&](int c) {
            return mix(gather(shading_.ramp + c, index), gather(shading_.ramp + c + next, index), t.v);
        };
        return {channel(0), channel(1), channel(2)};
    }

    // Trilinear interpolation, as for a texture; 1e30 outside the grid.
    HWY_INLINE Float distance_in_grid(Vec3 position) const {
        const DI di;
        const LesionGrid& grid = shading_.grid;
        VI low[3], step[3];
        V part[3];
        Mask inside = position.z < kNothing;
        std::int32_t stride = 1;
        for (int i = 0; i < 3; ++i) {
            const vec4& row = grid.from_eye[i];
            const Float at = dot(position, Vec3(row)) + row.w;
            const auto last = static_cast<float>(grid.size[i] - 1);
            inside = inside && at >= -0.5F && at <= last + 0.5F;
            const Float held = clamp(at, 0.0F, last), whole = hn::Floor(held.v);
            part[i] = (held - whole).v;
            const VI index = hn::ConvertTo(di, whole.v), next = hn::Add(index, hn::Set(di, 1));
            low[i] = hn::Mul(index, hn::Set(di, stride));
            step[i] = hn::Sub(hn::Mul(hn::Min(next, hn::Set(di, grid.size[i] - 1)), hn::Set(di, stride)), low[i]);
            stride *= grid.size[i];
        }
        if (!any(inside)) return 1e30F;
        const auto along_x = [&](VI from) {
            return mix(gather(grid.values, from), gather(grid.values, hn::Add(from, step[0])), part[0]);
        };
        const auto along_xy = [&](VI from) { return mix(along_x(from), along_x(hn::Add(from, step[1])), part[1]); };
        const VI corner = hn::Add(low[0], hn::Add(low[1], low[2]));
        return select(inside, mix(along_xy(corner), along_xy(hn::Add(corner, step[2])), part[2]), 1e30F);
    }

    const Shading& shading_;
    const PictureArrays& arrays_;
};

} // namespace ramus::render::caster::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
