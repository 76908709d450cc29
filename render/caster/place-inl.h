// The places that are shaded: where each lies before the eye, whose it is, which way it faces. Included once per
// instruction set.
#if defined(RAMUS_CASTER_PLACE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef RAMUS_CASTER_PLACE_INL_H
#undef RAMUS_CASTER_PLACE_INL_H
#else
#define RAMUS_CASTER_PLACE_INL_H
#endif

#include "render/caster/lanes-inl.h"
#include "render/scene/record_flags.h"

HWY_BEFORE_NAMESPACE();
namespace ramus::render::caster::HWY_NAMESPACE {

using namespace record;

HWY_INLINE V positive(V x) { return hn::Max(x, hn::Zero(D())); }
HWY_INLINE V power(V x, float exponent) { return power_of_two(hn::Mul(set(exponent), binary_logarithm(x))); }
HWY_INLINE V to_linear(V c) {
    return hn::IfThenElse(hn::Le(c, set(0.04045F)), hn::Mul(c, set(1.0F / 12.92F)),
                          power(hn::Mul(hn::Add(c, set(0.055F)), set(1.0F / 1.055F)), 2.4F));
}
HWY_INLINE V to_srgb(V c) {
    return hn::IfThenElse(hn::Le(c, set(0.0031308F)), hn::Mul(c, set(12.92F)),
                          hn::MulSub(set(1.055F), power(c, 1.0F / 2.4F), set(0.055F)));
}
HWY_INLINE V3 to_linear(V3 c) { return {to_linear(c.x), to_linear(c.y), to_linear(c.z)}; }

// Of `count` records from `first` on, what all shading needs.
struct Place {
    VU id, flags;
    V3 albedo, normal, at, towards_eye;
    V far, diagonal; // diagonal: x + y in the picture, pixels
    VI in_picture;
};

HWY_INLINE Place PlaceOf(const View& view, const Shading& shading, const std::uint32_t* places,
                         const std::uint32_t* ids, const std::uint32_t* normals, const float* depths, int x, int y) {
    const D d;
    const DU du;
    const DI di;
    Place p;
    const VU place = hn::And(hn::LoadU(du, places), hn::Set(du, kPixelMask));
    const VI column = hn::Add(hn::BitCast(di, hn::And(place, hn::Set(du, std::uint32_t{kTile - 1}))), hn::Set(di, x));
    const VI row = hn::Add(hn::BitCast(di, hn::ShiftRight<5>(place)), hn::Set(di, y));
    static_assert(kTile == 32);
    p.in_picture = index_of(row, hn::Set(di, view.stride), column);
    p.diagonal = hn::Add(hn::ConvertTo(d, hn::Add(column, row)), set(1.0F));
    p.id = hn::LoadU(du, ids);
    const auto of_branch = hn::Eq(hn::And(p.id, hn::Set(du, kSolid)), hn::Zero(du));
    const VU branch = hn::IfThenElseZero(of_branch, hn::Sub(hn::AndNot(hn::Set(du, kLine), p.id), hn::Set(du, 1U)));
    const VI word = hn::BitCast(di, hn::ShiftLeft<1>(branch));
    const VU red_green = gather(shading.branches, word), blue_flags = gather(shading.branches + 1, word);
    p.flags = hn::IfThenElseZero(of_branch, hn::ShiftRight<16>(blue_flags));
    const VU low = hn::Set(du, 0xffffU);
    const V unit = set(1.0F / 65535.0F);
    const auto value = [&](VU bits) { return hn::Mul(hn::ConvertTo(d, hn::BitCast(di, bits)), unit); };
    p.albedo = {value(hn::And(red_green, low)), value(hn::ShiftRight<16>(red_green)), value(hn::And(blue_flags, low))};
    p.normal = unpacked_normal(hn::LoadU(du, normals));
    const V depth = hn::LoadU(d, depths), half = set(0.5F);
    p.at = eye_position(view, hn::Add(hn::ConvertTo(d, column), half), hn::Add(hn::ConvertTo(d, row), half), depth);
    p.towards_eye =
        view.flat ? V3{hn::Zero(d), hn::Zero(d), set(1.0F)} : normalised({hn::Neg(p.at.x), hn::Neg(p.at.y), p.at.z});
    p.far = clamp01(hn::Mul(hn::Sub(depth, set(view.near_mm)), set(1.0F / (view.far_mm - view.near_mm))));
    return p;
}

} // namespace ramus::render::caster::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
