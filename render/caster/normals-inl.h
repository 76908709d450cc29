// Normals in 32 bits, as the shaders have them. Included once per instruction set.
#if defined(RAMUS_CASTER_NORMALS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef RAMUS_CASTER_NORMALS_INL_H
#undef RAMUS_CASTER_NORMALS_INL_H
#else
#define RAMUS_CASTER_NORMALS_INL_H
#endif

#include "render/caster/glsl-inl.h"

HWY_BEFORE_NAMESPACE();
namespace ramus::render::caster::HWY_NAMESPACE {

#define INLINE HWY_INLINE
#include "shaders/look/octahedral.glsl"
#undef INLINE

// `n` may have any length.
HWY_INLINE VU packed_normal(Vec3 n) {
    const Vec2 p = octahedral(n);
    const auto word = [](Float x) { return rounded((x * 32767.0F).v); };
    return hn::Or(hn::And(word(p.x), hn::Set(DU(), 0xffffU)), hn::ShiftLeft<16>(word(p.y)));
}

HWY_INLINE Vec3 unpacked_normal(VU bits) {
    const VI low = hn::ShiftRight<16>(hn::BitCast(DI(), hn::ShiftLeft<16>(bits)));
    const VI high = hn::ShiftRight<16>(hn::BitCast(DI(), bits));
    const auto number = [](VI word) { return Float(hn::ConvertTo(D(), word)) * (1.0F / 32767.0F); };
    return from_octahedral({number(low), number(high)});
}

} // namespace ramus::render::caster::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
