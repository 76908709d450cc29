// What the colours of a place say: its value on a scale, how far it is from lesions, whether it is lost. Included once
// per instruction set.
#if defined(RAMUS_CASTER_MEANING_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef RAMUS_CASTER_MEANING_INL_H
#undef RAMUS_CASTER_MEANING_INL_H
#else
#define RAMUS_CASTER_MEANING_INL_H
#endif

#include "render/caster/place-inl.h"

HWY_BEFORE_NAMESPACE();
namespace ramus::render::caster::HWY_NAMESPACE {

HWY_INLINE V3 OnScale(const Shading& shading, V value, V3 otherwise) {
    const D d;
    const DI di;
    const M known = hn::Ge(value, hn::Zero(d));
    if (shading.scale_logarithmic) value = hn::Mul(binary_logarithm(value), set(0.69314718F));
    const float steps = static_cast<float>(shading.ramp_steps);
    const V place = clamp01(hn::Mul(hn::Sub(value, set(shading.scale_low)), set(shading.scale_slope)));
    // As a texture is read: texels' values lie in their middles.
    const V at = hn::Min(positive(hn::MulSub(place, set(steps), set(0.5F))), set(steps - 1.0F));
    const V low = hn::Min(hn::Floor(at), set(steps > 1.0F ? steps - 2.0F : 0.0F));
    const V t = hn::Sub(at, low);
    const VI index = hn::Mul(hn::NearestInt(low), hn::Set(di, 3));
    const int next = shading.ramp_steps > 1 ? 3 : 0;
    const auto channel = [&](int c) {
        return mix(gather(shading.ramp + c, index), gather(shading.ramp + c + next, index), t);
    };
    return choose(known, to_linear({channel(0), channel(1), channel(2)}), otherwise);
}

// How far inside the lost part of its branch, in mm; negative outside. As behind_cut() of scene.glsl.
HWY_INLINE V BehindCut(const Shading& shading, V branch, V from_root, V3 at) {
    V inside = set(-1e30F);
    for (int i = 0; i < shading.cut_count; ++i) {
        const float* part = shading.cuts + std::ptrdiff_t{20} * i;
        const M own = hn::Eq(branch, set(part[0]));
        if (hn::AllFalse(D(), own)) continue;
        const auto outward_of = [&](const float* end) {
            const V way = hn::Sub(from_root, set(end[7]));
            const V3 away = at - set(end);
            return hn::IfThenElse(hn::Lt(hn::Abs(way), set(2.5F * end[3])), dot(away, set(end + 4)), way);
        };
        const V from = part[1] > 0.5F ? outward_of(part + 4) : set(1e30F);
        const V to = part[2] > 0.5F ? hn::Neg(outward_of(part + 12)) : set(1e30F);
        inside = hn::IfThenElse(own, hn::Max(inside, hn::Min(from, to)), inside);
    }
    return inside;
}

// What is lost is dark and hatched; a clean ring ends it at the cut. As lost() of shade.frag.
HWY_INLINE V3 Lost(const View& view, const Shading& shading, const Place& p, V from_root, V3 albedo) {
    const V pixel_mm = view.flat ? set(view.mm_a_pixel) : hn::Mul(set(view.mm_a_pixel), p.at.z);
    const M whole = any_of(p.flags, kLost), cut = any_of(p.flags, kCut);
    const V branch = hn::ConvertTo(D(), hn::BitCast(DI(), hn::Sub(p.id, hn::Set(DU(), 1U))));
    V behind = hn::IfThenElse(whole, set(1e30F), set(-1e30F));
    if (!hn::AllFalse(D(), cut))
        behind = hn::IfThenElse(cut, hn::Max(behind, BehindCut(shading, branch, from_root, p.at)), behind);
    const float thick = shading.look.more[2];
    const V across = fract(hn::Mul(p.diagonal, set(1.0F / (9.0F * thick))));
    const V stripe = hn::Mul(smooth_step(0.0F, 0.16F, across), hn::Sub(set(1.0F), smooth_step(0.34F, 0.5F, across)));
    const V3 hatched = mix(set(0.50F), set(1.35F), stripe) * set(shading.look.lost);
    const V per_pixel = inverse_of(pixel_mm);
    const V3 found = mix(albedo, hatched, clamp01(hn::MulAdd(behind, per_pixel, set(0.5F))));
    const V3 ring{set(0.92F), set(0.92F), set(0.92F)};
    const V beside = hn::Mul(hn::Abs(behind), hn::Mul(per_pixel, set(1.0F / thick)));
    return choose(any_of(p.flags, kLost | kCut), mix(ring, found, smooth_step(0.8F, 1.6F, beside)), albedo);
}

// How far from the nearest lesion, mm. As distance_to_lesions() of scene.glsl.
HWY_INLINE V DistanceToLesions(const MarginLook& look, V3 at) {
    const D d;
    const DI di;
    V nearest = set(1e30F);
    for (int i = 0; i < look.sphere_count; ++i) {
        const float* sphere = look.spheres + std::ptrdiff_t{4} * i;
        const V3 away = at - set(sphere);
        nearest = hn::Min(nearest, hn::Sub(root_of(hn::Max(dot(away, away), set(1e-20F))), set(sphere[3])));
    }
    if (look.grid == nullptr) return nearest;
    // Eight samples around, and how far the place lies from the lower ones; as a texture is read.
    VI low[3], step[3];
    V part[3];
    M inside = hn::Lt(at.z, set(kNothing));
    std::int32_t stride = 1;
    for (int i = 0; i < 3; ++i) {
        const float* row = look.to_grid[i];
        const V place = hn::Add(dot(at, set(row)), set(row[3]));
        const auto last = static_cast<float>(look.size[i] - 1);
        inside = hn::And(inside, hn::And(hn::Ge(place, set(-0.5F)), hn::Le(place, set(last + 0.5F))));
        const V held = hn::Min(hn::Max(place, hn::Zero(d)), set(last)), whole = hn::Floor(held);
        part[i] = hn::Sub(held, whole);
        const VI index = hn::ConvertTo(di, whole);
        low[i] = hn::Mul(index, hn::Set(di, stride));
        step[i] = hn::Sub(
            hn::Mul(hn::Min(hn::Add(index, hn::Set(di, 1)), hn::Set(di, look.size[i] - 1)), hn::Set(di, stride)),
            low[i]);
        stride *= look.size[i];
    }
    if (hn::AllFalse(d, inside)) return nearest;
    const VI corner = hn::Add(low[0], hn::Add(low[1], low[2]));
    const auto along_x = [&](VI from) {
        return mix(gather(look.grid, from), gather(look.grid, hn::Add(from, step[0])), part[0]);
    };
    const auto along_xy = [&](VI from) { return mix(along_x(from), along_x(hn::Add(from, step[1])), part[1]); };
    const V there = mix(along_xy(corner), along_xy(hn::Add(corner, step[2])), part[2]);
    return hn::IfThenElse(inside, hn::Min(nearest, there), nearest);
}

// As margin_colour() of scene.glsl.
HWY_INLINE V3 MarginColour(const View& view, const Shading& shading, V3 at) {
    const MarginLook& look = *shading.margins;
    const V mm = DistanceToLesions(look, at);
    const V per_pixel = inverse_of(view.flat ? set(view.mm_a_pixel) : hn::Mul(set(view.mm_a_pixel), at.z));
    V3 found = set(look.beyond);
    V edge = set(1.0F);
    for (int i = look.band_count - 1; i >= 0; --i) {
        const V inside = hn::Mul(hn::Sub(set(look.bands[i][3]), mm), per_pixel);
        found = mix(found, set(look.bands[i]), clamp01(hn::Add(inside, set(0.5F))));
        edge = hn::Min(edge, hn::Mul(hn::Abs(inside), set(1.0F / shading.look.more[2])));
    }
    return mix(set(0.45F), set(1.0F), smooth_step(0.5F, 1.3F, edge)) * found;
}

} // namespace ramus::render::caster::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
