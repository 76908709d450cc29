// Which samples of a block a triangle covers, at which depth, and how it faces there. Included once per instruction
// set.
#if defined(RAMUS_CASTER_COVERING_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef RAMUS_CASTER_COVERING_INL_H
#undef RAMUS_CASTER_COVERING_INL_H
#else
#define RAMUS_CASTER_COVERING_INL_H
#endif

#include "render/caster/meeting-inl.h"

HWY_BEFORE_NAMESPACE();
namespace ramus::render::caster::HWY_NAMESPACE {

// Twice the areas that places of the picture span with the edges: positive inside.
struct Spans {
    V of[3];
};
HWY_INLINE Spans spans_of(const Triangle& t, float x, float y, int lane, float off_x, float off_y) {
    const V px = hn::Add(hn::Load(D(), kColumn + lane), set(x + off_x));
    const V py = hn::Add(hn::Load(D(), kRow + lane), set(y + off_y));
    Spans spans;
    for (int i = 0; i < 3; ++i) {
        const Triangle::Edge& e = t.edge[i];
        spans.of[i] =
            hn::Sub(hn::Mul(set(e.way_x), hn::Sub(py, set(e.y))), hn::Mul(set(e.way_y), hn::Sub(px, set(e.x))));
    }
    return spans;
}

struct Covering {
    M there;
    V depth;
};
template <bool Flat> HWY_INLINE Covering covering(const Triangle& t, float x, float y, int lane, int sample) {
    const Spans spans = spans_of(t, x, y, lane, kSampleX[sample], kSampleY[sample]);
    Covering found{hn::FirstN(D(), 16), hn::Zero(D())};
    for (int i = 0; i < 3; ++i) {
        const V zero = hn::Zero(D());
        found.there = hn::And(found.there, t.edge[i].own ? hn::Ge(spans.of[i], zero) : hn::Gt(spans.of[i], zero));
        found.depth = hn::MulAdd(spans.of[i], set(t.depth[i]), found.depth);
    }
    if constexpr (!Flat) found.depth = inverse_of(found.depth);
    return found;
}

// At the pixels' middles, as fragment_list.frag has it: of any length; of lines, in x how much of the pixel they take.
HWY_INLINE V3 facing(const Triangle& t, float x, float y, int lane) {
    const Spans spans = spans_of(t, x, y, lane, 0.5F, 0.5F);
    if (t.half_width > 0.0F) { // as line_share() of context.frag
        V nearest = set(kNothing);
        for (int i = 0; i < 3; ++i)
            nearest = hn::Min(nearest, hn::Mul(hn::Abs(spans.of[i]), set(t.share / t.slope[i])));
        const V share = clamp01(hn::Sub(set(t.half_width + 0.5F), nearest));
        const float thin = 2.0F * t.half_width < 1.0F ? 2.0F * t.half_width : 1.0F;
        return {hn::Mul(share, set(thin * t.crowded)), hn::Zero(D()), hn::Zero(D())};
    }
    V3 sum{hn::Zero(D()), hn::Zero(D()), hn::Zero(D())};
    for (int i = 0; i < 3; ++i) sum = sum + hn::Mul(spans.of[i], set(t.share)) * set(t.normal[i]);
    return sum;
}

} // namespace ramus::render::caster::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
