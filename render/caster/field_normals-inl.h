// Which way the convolution surface faces where rays hit its cones: cones alone have creases where vessels fork and
// bend, and the field that the surface is made of has none. Included once per instruction set.
#if defined(RAMUS_CASTER_FIELD_NORMALS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef RAMUS_CASTER_FIELD_NORMALS_INL_H
#undef RAMUS_CASTER_FIELD_NORMALS_INL_H
#else
#define RAMUS_CASTER_FIELD_NORMALS_INL_H
#endif

#include "render/caster/local_field-inl.h"

HWY_BEFORE_NAMESPACE();
namespace ramus::render::caster::HWY_NAMESPACE {

// Gradient of the field around the cone, per mm; depth as +z.
HWY_INLINE Vec3 local_gradient(const Field& field, std::uint32_t cone, Mask here, Vec3 at) {
    const auto inverse_root = kernel::set(kernel::PackTag<2>(), 1.0F / field.root_width);
    Vec3 sum(0.0F);
    const auto add = [&](std::uint32_t, const kernel::Segments<2>& pair, const kernel::Foot<2>& foot) {
        const Float closest = hn::Min(foot.rho.v[0], foot.rho.v[1]);
        if (!any(here && closest < kernel::kFadeEndScaled)) return;
        const kernel::KernelGradient<2> g =
            kernel::Gaussian::gradient<kernel::Ends::kSome>(pair, foot, kernel::growth_of(pair, foot, inverse_root));
        for (int s = 0; s < 2; ++s) {
            const Float radial = g.radial.v[s], axial = g.axial.v[s];
            sum = mad(radial, Vec3(foot.qx.v[s], foot.qy.v[s], foot.qz.v[s]),
                      mad(axial, Vec3(pair.ux.v[s], pair.uy.v[s], pair.uz.v[s]), sum));
        }
    };
    for_neighbours(field, field.neighbours, field.first[cone], field.first[cone + 1], at, add);
    return sum;
}

// Normals of the points `at` where rays hit `cones`, of `which` of them; `normal` (of any length) elsewhere, and where
// the field says nothing sound.
HWY_INLINE Vec3 field_normals(const Field& field, Mask which, VU cones, Vec3 at, Vec3 normal) {
    const D d;
    const DU du;
    alignas(64) std::uint32_t index[hn::MaxLanes(D())];
    hn::Store(cones, du, index);
    const Vec3 before = normalize(normal);
    for (Mask left = which; any(left);) {
        const std::uint32_t cone = index[hn::FindFirstTrue(d, left.m)];
        // Neighbours of one cone are those of the cones next to it, in the few pixels looked at.
        Mask here = {hn::FirstN(d, 0)};
        for (std::uint32_t i = field.first[cone]; i < field.first[cone + 1]; ++i)
            here = here || Uint{cones} == field.neighbours[i];
        here = here && left;
        left = left && !here;
        const Vec3 inward = local_gradient(field, cone, here, at);
        Vec3 outward = {-inward.x, -inward.y, inward.z}; // depth grows away from the eye, normals have z towards it
        const Float squared = dot(outward, outward);
        outward = Float(inverse_root(max(squared, 1e-20F).v)) * outward;
        normal = select(here && squared > 1e-12F && dot(outward, before) > 0.0F, outward, normal);
    }
    return normal;
}

} // namespace ramus::render::caster::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
