// Which way the convolution surface faces where rays meet its cones: cones alone have creases where vessels fork and
// bend, and the field that the surface is made of has none. Included once per instruction set.
#if defined(RAMUS_CASTER_BLENDED_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef RAMUS_CASTER_BLENDED_INL_H
#undef RAMUS_CASTER_BLENDED_INL_H
#else
#define RAMUS_CASTER_BLENDED_INL_H
#endif

#include "render/caster/near-inl.h"

HWY_BEFORE_NAMESPACE();
namespace ramus::render::caster::HWY_NAMESPACE {

// Of the field of what is near the cone, per mm; depth as +z.
HWY_INLINE V3 GradientNear(const Field& field, std::uint32_t cone, M here, V3 at) {
    const D d;
    const auto inverse_root = kernel::set(kernel::PackTag<2>(), 1.0F / field.root_width);
    V3 sum{hn::Zero(d), hn::Zero(d), hn::Zero(d)};
    const auto add = [&](std::uint32_t, const kernel::Segments<2>& pair, const kernel::Foot<2>& foot) {
        const V closest = hn::Min(foot.rho.v[0], foot.rho.v[1]);
        if (hn::AllFalse(d, hn::And(here, hn::Lt(closest, set(kernel::kFadeEndScaled))))) return;
        const kernel::KernelGradient<2> g =
            kernel::Gaussian::gradient<kernel::Ends::kSome>(pair, foot, kernel::growth_of(pair, foot, inverse_root));
        for (int s = 0; s < 2; ++s) {
            sum.x = hn::MulAdd(g.radial.v[s], foot.qx.v[s], hn::MulAdd(g.axial.v[s], pair.ux.v[s], sum.x));
            sum.y = hn::MulAdd(g.radial.v[s], foot.qy.v[s], hn::MulAdd(g.axial.v[s], pair.uy.v[s], sum.y));
            sum.z = hn::MulAdd(g.radial.v[s], foot.qz.v[s], hn::MulAdd(g.axial.v[s], pair.uz.v[s], sum.z));
        }
    };
    for_pieces(field, field.near, field.first[cone], field.first[cone + 1], at, add);
    return sum;
}

// Normals of the places that rays met `cones` at, of `which` of them; `normal` (of any length) elsewhere, and where the
// field says nothing sound.
HWY_INLINE V3 Blended(const Field& field, M which, VU cones, V3 at, V3 normal) {
    const D d;
    const DU du;
    alignas(64) std::uint32_t index[hn::MaxLanes(D())];
    hn::Store(cones, du, index);
    const V3 before = normalised(normal);
    for (M left = which; !hn::AllFalse(d, left);) {
        const std::uint32_t cone = index[hn::FindFirstTrue(d, left)];
        // What is near one cone is near those next to it, in the few pixels looked at.
        M here = hn::FirstN(d, 0);
        for (std::uint32_t i = field.first[cone]; i < field.first[cone + 1]; ++i)
            here = hn::Or(here, mask(hn::Eq(cones, hn::Set(du, field.near[i]))));
        here = hn::And(here, left);
        left = hn::AndNot(here, left);
        V3 outward = GradientNear(field, cone, here, at); // it grows inward, and normals have z towards the eye
        outward.x = hn::Neg(outward.x);
        outward.y = hn::Neg(outward.y);
        const V squared = dot(outward, outward);
        outward = inverse_root(hn::Max(squared, set(1e-20F))) * outward;
        const M sound = hn::And(hn::Gt(squared, set(1e-12F)), hn::Gt(dot(outward, before), set(0.0F)));
        normal = choose(hn::And(here, sound), outward, normal);
    }
    return normal;
}

} // namespace ramus::render::caster::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
