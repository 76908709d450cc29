// What a place on a vessel looks like: the light of shade.frag, a vector of places at a time. Included once per
// instruction set.
#if defined(RAMUS_CASTER_LIGHT_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef RAMUS_CASTER_LIGHT_INL_H
#undef RAMUS_CASTER_LIGHT_INL_H
#else
#define RAMUS_CASTER_LIGHT_INL_H
#endif

#include "render/caster/meaning-inl.h"

HWY_BEFORE_NAMESPACE();
namespace ramus::render::caster::HWY_NAMESPACE {

constexpr float kKey[3] = {-0.429F, 0.572F, 0.699F}, kFill[3] = {0.772F, -0.051F, 0.634F};

HWY_INLINE V to_8(V x) {
    const V x2 = hn::Mul(x, x), x4 = hn::Mul(x2, x2);
    return hn::Mul(x4, x4);
}
HWY_INLINE V to_24(V x) {
    const V x8 = to_8(x);
    return hn::Mul(x8, hn::Mul(x8, x8));
}
HWY_INLINE V to_60(V x) {
    const V x2 = hn::Mul(x, x), x4 = hn::Mul(x2, x2), x8 = hn::Mul(x4, x4), x20 = hn::Mul(hn::Mul(x8, x8), x4);
    return hn::Mul(x20, hn::Mul(x20, x20));
}
HWY_INLINE V to_70(V x) {
    const V x2 = hn::Mul(x, x), x8 = to_8(x), x32 = hn::Mul(hn::Mul(x8, x8), hn::Mul(x8, x8));
    return hn::Mul(hn::Mul(x32, x32), hn::Mul(x2, hn::Mul(x2, x2)));
}
HWY_INLINE V3 Chromatic(V far) {
    const V3 near_red{set(0.78F), set(0.045F), set(0.03F)}, violet{set(0.42F), set(0.05F), set(0.36F)},
        far_blue{set(0.035F), set(0.11F), set(0.72F)};
    const V twice = hn::Add(far, far);
    return choose(hn::Lt(far, set(0.5F)), mix(near_red, violet, twice),
                  mix(violet, far_blue, hn::Sub(twice, set(1.0F))));
}

// How much of the ring around a pixel shows something nearer; as halo() of shade.frag.
HWY_INLINE V Halo(const View& view, const Shading& shading, const Place& p, const PictureArrays& picture) {
    const DI di;
    const float least = 0.006F * (view.far_mm - view.near_mm), slope = 1.0F / (11.0F * least);
    const VI row = hn::NearestInt(hn::Floor(hn::Div(hn::ConvertTo(D(), p.in_picture), set(float(view.stride)))));
    const VI column = hn::Sub(p.in_picture, hn::Mul(row, hn::Set(di, view.stride)));
    V sum = hn::Zero(D());
    for (const auto& step : shading.halo_ring) {
        const VI tx = hn::Add(column, hn::Set(di, step[0])), ty = hn::Add(row, hn::Set(di, step[1]));
        const VI cx = hn::Min(hn::Max(tx, hn::Zero(di)), hn::Set(di, view.width - 1));
        const VI cy = hn::Min(hn::Max(ty, hn::Zero(di)), hn::Set(di, view.height - 1));
        const V before = hn::Sub(p.at.z, gather(picture.depth, index_of(cy, hn::Set(di, view.stride), cx)));
        sum = hn::Add(sum, clamp01(hn::Mul(hn::Sub(before, set(least)), set(slope))));
    }
    return clamp01(hn::Mul(sum, set(1.0F / 3.0F)));
}

// How much of the key light what the picture shows takes from a place; as shadowed() of shade.frag.
HWY_INLINE V Shadowed(const View& view, const Place& p, const PictureArrays& picture) {
    const D d;
    const DI di;
    const V one = set(1.0F);
    const V reach = view.flat ? set(2.2F * view.reach_mm) : hn::Mul(set(2.2F * view.reach_mm), p.at.z);
    const V least = hn::Mul(set(0.012F), reach), inverse_reach = hn::Div(one, reach);
    const V3 start = p.at + least * V3{p.normal.x, p.normal.y, hn::Neg(p.normal.z)};
    V hidden = hn::Zero(d);
    for (int i = 1; i <= 30; ++i) {
        const float part = static_cast<float>(i) / 30.0F, t = part * (0.3F + 0.7F * part);
        const V3 at = start + hn::Mul(set(t), reach) * V3{set(kKey[0]), set(kKey[1]), set(-kKey[2])};
        const V scale = view.flat ? set(1.0F / view.mm_a_pixel) : hn::Div(set(1.0F / view.mm_a_pixel), at.z);
        const auto tap = [&](V along, float centre, int count) {
            const VI pixel = hn::ConvertTo(di, hn::Floor(hn::MulAdd(along, scale, set(centre))));
            return hn::Min(hn::Max(pixel, hn::Zero(di)), hn::Set(di, count - 1));
        };
        const VI x = tap(at.x, view.centre_x, view.width), y = tap(at.y, view.centre_y, view.height);
        const V before = hn::Sub(at.z, gather(picture.depth, index_of(y, hn::Set(di, view.stride), x)));
        const V inside =
            clamp01(hn::Div(hn::Sub(before, least), hn::MulAdd(set(2.0F), least, hn::Mul(set(0.12F * t), reach))));
        const V near = clamp01(hn::NegMulAdd(set(2.0F), hn::Mul(before, inverse_reach), set(2.0F)));
        hidden = hn::Max(hidden, hn::Mul(hn::Mul(inside, near), set(1.0F - t)));
    }
    return hidden;
}

// Of lesions or context.
struct Matter {
    V3 colour;
    V opacity; // negative: lines
};
HWY_INLINE Matter ContextOf(const Shading& shading, VU id) {
    const M there = hn::And(any_of(id, kSolid), any_of(id, kContext));
    const VU index = hn::Sub(hn::And(id, hn::Set(DU(), kNumberBits)), hn::Set(DU(), 1U));
    const VI first = hn::BitCast(DI(), hn::ShiftLeft<2>(hn::IfThenElseZero(hn::RebindMask(DU(), there), index)));
    const auto channel = [&](int c) { return gather(shading.context + c, first); };
    return {{channel(0), channel(1), channel(2)}, channel(3)};
}

// As shade() and line() of shade.frag.
HWY_INLINE V3 Radiance(const View& view, const Shading& shading, const Place& p, V value,
                       const PictureArrays& picture) {
    const D d;
    const Look& look = shading.look;
    const V one = set(1.0F), zero = hn::Zero(d);
    const M highlighted = any_of(p.flags, kHighlighted), selected = any_of(p.flags, kSelected),
            calm = any_of(p.flags, kCalm);
    V3 albedo = p.albedo;
    if (shading.ramp != nullptr) albedo = choose(highlighted, albedo, OnScale(shading, value, albedo));
    if (shading.margins != nullptr) albedo = choose(highlighted, albedo, MarginColour(view, shading, p.at));
    if (!hn::AllFalse(d, any_of(p.flags, kLost | kCut))) albedo = Lost(view, shading, p, value, albedo);
    const M context = any_of(p.id, kSolid);
    if (!hn::AllFalse(d, context)) albedo = choose(context, ContextOf(shading, p.id).colour, albedo);
    const V facing = clamp01(dot(p.normal, p.towards_eye)), aside = hn::Sub(one, facing);
    if (look.cues[2] > 0.0F)
        albedo = choose(hn::Or(highlighted, context), albedo, mix(albedo, Chromatic(p.far), set(look.cues[2])));
    if (!hn::AllFalse(d, selected)) albedo = choose(selected, mix(albedo, set(look.selection), set(0.62F)), albedo);
    if (!hn::AllFalse(d, calm)) {
        const V grey = dot(albedo, {set(0.2126F), set(0.7152F), set(0.0722F)});
        albedo = choose(calm, set(0.62F) * mix(V3{grey, grey, grey}, albedo, set(0.38F)), albedo);
    }
    const V occluded = hn::Mul(set(look.more[0]), gather(picture.smooth, p.in_picture));
    const V open = hn::Sub(one, occluded);
    const V3 key = set(kKey), fill = set(kFill);
    const V key_light = positive(hn::Mul(hn::Add(dot(p.normal, key), set(0.06F)), set(1.0F / 1.06F)));
    const V fill_light = positive(hn::Mul(hn::Add(dot(p.normal, fill), set(0.30F)), set(1.0F / 1.30F)));
    const V key_shine = positive(dot(p.normal, normalised(key + p.towards_eye)));
    const V fill_shine = positive(dot(p.normal, normalised(fill + p.towards_eye)));
    const V up = hn::MulAdd(set(0.5F), p.normal.y, set(0.5F));
    const V3 ambient = mix(V3{set(0.085F), set(0.070F), set(0.074F)}, V3{set(0.190F), set(0.205F), set(0.240F)}, up);
    V shadow = hn::MulAdd(set(0.75F), hn::Sub(open, one), one);
    V fill_share = one;
    if (look.more[3] > 0.0F) {
        const V lit_share = hn::NegMulAdd(set(0.85F * look.more[3]), Shadowed(view, p, picture), one);
        shadow = hn::Mul(shadow, lit_share);
        fill_share = hn::MulAdd(set(0.45F), lit_share, set(0.55F));
    }
    const V key_amount = hn::Mul(set(1.50F * look.lights[0]), hn::Mul(key_light, shadow));
    const V fill_amount = hn::Mul(set(0.34F * look.lights[1]), hn::Mul(hn::Mul(fill_light, fill_share), open));
    V3 light = hn::Mul(open, open) * ambient;
    light = light + key_amount * V3{one, set(0.965F), set(0.915F)} + fill_amount * V3{set(0.80F), set(0.90F), one};
    V3 radiance = albedo * light;
    const V shine = hn::Mul(set(look.lights[3]), shadow), glint = hn::Mul(set(0.25F), to_70(key_shine));
    const V sheen = hn::Mul(set(0.03F), to_24(fill_shine));
    radiance = radiance + shine * V3{hn::Add(glint, sheen), hn::MulAdd(glint, set(0.98F), sheen),
                                     hn::MulAdd(glint, set(0.95F), sheen)};
    const V rim = hn::Mul(hn::Mul(set(look.lights[2]), hn::Mul(aside, hn::Mul(aside, aside))),
                          hn::Mul(open, hn::MulAdd(set(0.4F), p.normal.y, set(0.6F))));
    radiance = radiance + rim * (set(0.14F) * albedo + V3{set(0.015F), set(0.0174F), set(0.020F)});
    if (!hn::AllFalse(d, highlighted))
        radiance = choose(highlighted, set(1.10F) * radiance + set(0.05F) * albedo, radiance);
    if (look.cues[1] > 0.0F)
        radiance =
            hn::NegMulAdd(set(look.cues[1] * 0.85F), hn::Sub(one, smooth_step(0.12F, 0.42F, facing)), one) * radiance;
    const V cue = hn::Mul(hn::Mul(set(look.background_bottom[3]), hn::IfThenElse(highlighted, set(0.25F), set(0.68F))),
                          hn::Mul(p.far, hn::Sqrt(p.far)));
    radiance = mix(radiance, set(look.far_colour), cue);
    const V squared = hn::Mul(aside, aside);
    const auto glow = [&](std::uint32_t flag, float base, float edge, float white, float share) {
        const M there = any_of(p.flags, flag);
        if (hn::AllFalse(d, there)) return;
        const V3 pale{set(white), set(white), set(white)};
        radiance = choose(there, radiance + hn::MulAdd(set(edge), squared, set(base)) * mix(albedo, pale, set(share)),
                          radiance);
    };
    glow(kHovered, 0.10F, 0.55F, 0.8F, 0.55F);
    glow(kGlowing, 0.03F, 0.30F, 0.8F, 0.35F);
    const M line = any_of(p.id, kLine);
    if (!hn::AllFalse(d, line)) {
        V3 plain = set(look.line);
        plain = choose(selected, mix(plain, set(look.selection), set(0.8F)), plain);
        plain = choose(any_of(p.flags, kHovered), mix(plain, V3{one, set(0.85F), set(0.55F)}, set(0.6F)), plain);
        plain = choose(any_of(p.flags, kLost), mix(plain, set(look.lost), set(0.6F)), plain);
        plain = mix(plain, set(look.far_colour), hn::Mul(set(0.62F * look.background_bottom[3]), p.far));
        radiance = choose(line, plain, radiance);
    }
    if (look.cues[0] > 0.0F)
        radiance =
            hn::NegMulAdd(set(0.9F * look.cues[0]), hn::IfThenElse(line, zero, Halo(view, shading, p, picture)), one) *
            radiance;
    return radiance;
}

struct Veil {
    V3 radiance; // premultiplied
    V alpha;
};

// A shell of even thickness. As context_veil() of context.glsl; opacities are below 1.
HWY_INLINE Veil Shell(const Shading& shading, const Place& p, const Matter& look) {
    const Look& all = shading.look;
    const V facing = clamp01(dot(p.normal, p.towards_eye));
    const V through = power_of_two(
        hn::Mul(binary_logarithm(hn::Sub(set(1.0F), look.opacity)), inverse_of(mix(set(0.14F), set(1.0F), facing))));
    const V veil = hn::Sub(set(1.0F), through);
    const V3 key = set(kKey);
    const V light = hn::MulAdd(set(0.85F), positive(dot(p.normal, key)),
                               hn::MulAdd(set(0.15F), positive(dot(p.normal, set(kFill))), set(0.45F)));
    const V cue = hn::Mul(set(0.5F * all.background_bottom[3]), hn::Mul(p.far, hn::Sqrt(p.far)));
    const V3 radiance = mix(light * look.colour, set(all.far_colour), cue);
    const V shine = hn::Mul(hn::Mul(set(all.lights[3] * 0.22F), look.opacity),
                            to_60(positive(dot(p.normal, normalised(key + p.towards_eye)))));
    return {veil * radiance + V3{shine, shine, shine}, clamp01(hn::Add(veil, shine))};
}

// Of a mesh's edges: `shares` are the bits of how much of the pixel they take.
HWY_INLINE Veil Lines(const Shading& shading, const Place& p, const Matter& look, VU shares) {
    const V share = hn::Mul(hn::Neg(look.opacity), hn::BitCast(D(), shares));
    const V cue = hn::Mul(set(0.62F * shading.look.background_bottom[3]), p.far);
    return {share * mix(look.colour, set(shading.look.far_colour), cue), share};
}

// As glass() of shade.frag.
HWY_INLINE Veil Glass(const Shading& shading, const Place& p) {
    const Look& look = shading.look;
    const V one = set(1.0F);
    const V facing = clamp01(dot(p.normal, p.towards_eye));
    V veil = mix(set(0.16F), set(0.72F), power(hn::Sub(one, facing), 1.6F));
    V3 tint = set(look.glass);
    const M selected = any_of(p.flags, kSelected), hovered = any_of(p.flags, kHovered),
            glowing = any_of(p.flags, kGlowing);
    tint = choose(selected, mix(tint, set(look.selection), set(0.7F)), tint);
    tint = choose(hovered, set(1.6F) * tint, tint);
    tint = choose(glowing, set(1.3F) * tint, tint);
    const M lost = any_of(p.flags, kLost);
    if (!hn::AllFalse(D(), lost)) tint = choose(lost, mix(tint, set(1.4F) * set(look.lost), set(0.7F)), tint);
    const auto more = [&](M where, float by) { veil = hn::Add(veil, hn::IfThenElseZero(where, set(by))); };
    more(selected, 0.12F);
    more(hovered, 0.12F);
    more(glowing, 0.06F);
    const float opacity = look.more[1];
    veil = opacity < 1.0F ? hn::Mul(veil, set(opacity)) : mix(veil, set(0.97F), set(opacity - 1.0F));
    const V3 key = set(kKey);
    const V3 radiance = hn::MulAdd(set(0.85F), positive(dot(p.normal, key)), set(0.55F)) * tint;
    const V shine = hn::Mul(set((opacity < 1.0F ? opacity : 1.0F) * look.lights[3] * 0.40F),
                            to_60(positive(dot(p.normal, normalised(key + p.towards_eye)))));
    veil = hn::Mul(veil, hn::NegMulAdd(set(0.5F * look.background_bottom[3]), p.far, one));
    return {veil * radiance + V3{shine, shine, shine}, clamp01(hn::Add(veil, shine))};
}

} // namespace ramus::render::caster::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
