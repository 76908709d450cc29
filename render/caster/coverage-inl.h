// Which samples of a block a triangle covers, at which depth, and how it faces there. Included once per instruction
// set.
#if defined(RAMUS_CASTER_COVERAGE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef RAMUS_CASTER_COVERAGE_INL_H
#undef RAMUS_CASTER_COVERAGE_INL_H
#else
#define RAMUS_CASTER_COVERAGE_INL_H
#endif

#include "render/caster/intersection-inl.h"

HWY_BEFORE_NAMESPACE();
namespace ramus::render::caster::HWY_NAMESPACE {

// Twice the areas that points of the picture span with the edges: positive inside.
struct EdgeFunctions {
    Float of[3];
};
HWY_INLINE EdgeFunctions edge_functions(const Triangle& t, const Block& block, int lane, float right, float up) {
    const Float x = Float(hn::Load(D(), kColumn + lane)) + (block.x + right);
    const Float y = Float(hn::Load(D(), kRow + lane)) + (block.y + up);
    EdgeFunctions edges;
    for (int i = 0; i < 3; ++i) {
        const Triangle::Edge& e = t.edge[i];
        edges.of[i] = e.direction_x * (y - e.y) - e.direction_y * (x - e.x);
    }
    return edges;
}

struct Coverage {
    Mask covered;
    Float depth;
};
template <bool Flat> HWY_INLINE Coverage coverage(const Triangle& t, const Block& block, int lane, int sample) {
    const EdgeFunctions edges = edge_functions(t, block, lane, kSampleX[sample], kSampleY[sample]);
    Coverage found{{hn::FirstN(D(), kBlockPixels)}, 0.0F};
    for (int i = 0; i < 3; ++i) {
        found.covered = found.covered && (t.edge[i].own ? edges.of[i] >= 0.0F : edges.of[i] > 0.0F);
        found.depth = mad(edges.of[i], t.depth[i], found.depth);
    }
    if constexpr (!Flat) found.depth = reciprocal(found.depth);
    return found;
}

// At the pixels' middles, as in fragment_list.frag: of any length; of lines, in x how much of the pixel they take.
HWY_INLINE Vec3 pixel_normal(const Triangle& t, const Block& block, int lane) {
    const EdgeFunctions edges = edge_functions(t, block, lane, 0.5F, 0.5F);
    if (t.half_width > 0.0F) { // as line_share() of context.frag
        Float nearest = kNothing;
        for (int i = 0; i < 3; ++i) nearest = min(nearest, abs(edges.of[i]) * (t.share / t.slope[i]));
        const Float share = clamp(t.half_width + 0.5F - nearest, 0.0F, 1.0F);
        const float thin = 2.0F * t.half_width < 1.0F ? 2.0F * t.half_width : 1.0F;
        return {share * (thin * t.crowded), 0.0F, 0.0F};
    }
    Vec3 sum(0.0F);
    for (int i = 0; i < 3; ++i)
        sum = sum + edges.of[i] * t.share * Vec3(t.normal[i][0], t.normal[i][1], t.normal[i][2]);
    return sum;
}

} // namespace ramus::render::caster::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
