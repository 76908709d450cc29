// One opaque cone and the samples of one block. Included once per instruction set.
#if defined(RAMUS_CASTER_CAST_BLOCK_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef RAMUS_CASTER_CAST_BLOCK_INL_H
#undef RAMUS_CASTER_CAST_BLOCK_INL_H
#else
#define RAMUS_CASTER_CAST_BLOCK_INL_H
#endif

#include "render/caster/meeting-inl.h"
#include "render/caster/owner-inl.h"

HWY_BEFORE_NAMESPACE();
namespace ramus::render::caster::HWY_NAMESPACE {

// An untouched block holds what is left of another tile.
HWY_INLINE void Touch(int block, Samples& samples) {
    if (samples.touched[block]) return;
    samples.touched[block] = true;
    for (int sample = 0; sample < kSamples; ++sample)
        for (int lane = 0; lane < 16; lane += kN) {
            hn::Store(set(kNothing), D(), samples.depth[block][sample] + lane);
            hn::Store(hn::Zero(DU()), DU(), samples.id[block][sample] + lane);
        }
}

// What a sample sees of a cone.
struct Seen {
    V depth, at; // at: along the cone
    VU normal;
};

HWY_INLINE void Write(const Cone& cone, std::uint32_t number, bool with_values, int block, int sample, int lane,
                      M which, const Seen& seen, Samples& samples) {
    const D d;
    const DU du;
    const auto which_u = hn::RebindMask(du, which);
    const auto put = [&](std::uint32_t* to, VU value) {
        hn::Store(hn::IfThenElse(which_u, value, hn::Load(du, to + lane)), du, to + lane);
    };
    hn::Store(seen.depth, d, samples.depth[block][sample] + lane);
    put(samples.id[block][sample], hn::Set(du, cone.id));
    if (sample == 0) put(samples.cone[block], hn::Set(du, number));
    put(samples.normal[block][sample], seen.normal);
    if (!with_values) return;
    float* values = samples.value[block][sample] + lane;
    const V value = mix(set(cone.value[0]), set(cone.value[1]), seen.at);
    hn::Store(hn::IfThenElse(which, value, hn::Load(d, values)), d, values);
}

// Two samples at a time.
template <bool Flat>
HWY_INLINE void CastBlock(const View& view, const Cone& cone, std::uint32_t number, bool with_values, float x, float y,
                          int block, Samples& samples) {
    const D d;
    Touch(block, samples);
    V farthest = hn::Zero(d);
    for (int lane = 0; lane < 16; lane += kN) {
        bool any = false; // normals are those at the pixels' middles, once there is a sample to have them
        VU normal = hn::Zero(DU());
        for (int sample = 0; sample < kSamples; sample += 2) {
            const auto depths = [&](int s) { return hn::Load(d, samples.depth[block][s] + lane); };
            const Rays<V> first = rays_of(view, x, y, lane, sample), second = rays_of(view, x, y, lane, sample + 1);
            const auto found = meet<Flat, false>(cone, Rays<Pair>{{first.x, second.x}, {first.y, second.y}});
            const Pair old{depths(sample), depths(sample + 1)};
            const MaskPair nearer = And(found.there, Lt(found.depth, old));
            if (None(nearer)) {
                farthest = hn::Max(farthest, hn::Max(old.a, old.b));
                continue;
            }
            const Pair now = IfThenElse(nearer, found.depth, old);
            farthest = hn::Max(farthest, hn::Max(now.a, now.b));
            if (!any) normal = packed_normal(facing<Flat>(cone, rays_at(view, x, y, lane, 0.5F, 0.5F)));
            any = true;
            const auto write = [&](int s, M which, V depth, V at) {
                Write(cone, number, with_values, block, s, lane, which, {depth, at, normal}, samples);
            };
            write(sample, nearer.a, now.a, found.s.a);
            write(sample + 1, nearer.b, now.b, found.s.b);
        }
    }
    samples.farthest[block] = hn::GetLane(hn::MaxOfLanes(d, farthest));
}

// Where glass goes on from a cone it is open: the eye looks through to the inside of its far wall, which faces the eye
// as a lid would.
template <bool Flat>
HWY_INLINE void CastContested(const View& view, const Field& field, const Cone& cone, std::uint32_t number,
                              bool with_values, float x, float y, int block, Samples& samples) {
    const D d;
    Touch(block, samples);
    for (int lane = 0; lane < 16; lane += kN) {
        for (int sample = 0; sample < kSamples; ++sample) {
            const Rays<V> rays = rays_of(view, x, y, lane, sample);
            const auto found = meet<Flat, true>(cone, rays);
            const V old = hn::Load(d, samples.depth[block][sample] + lane);
            const M before = hn::And(found.there, hn::Lt(found.depth, old));
            if (hn::AllFalse(d, before)) continue;
            const auto own = [&](M which, V depth) {
                return OwnLeads(field, number, which, place_on(view, rays, depth));
            };
            const M front = own(before, found.depth), open = hn::AndNot(front, hn::And(before, hn::Lt(found.out, old)));
            const M lid = hn::AllFalse(d, open) ? open : own(open, found.out);
            const M seen = hn::Or(front, lid);
            const V depth = hn::IfThenElse(seen, hn::IfThenElse(lid, found.out, found.depth), old);
            const V zero = hn::Zero(d);
            const V3 normal =
                choose(lid, {zero, zero, set(1.0F)}, facing<Flat>(cone, rays_at(view, x, y, lane, 0.5F, 0.5F)));
            Write(cone, number, with_values, block, sample, lane, seen, {depth, found.s, packed_normal(normal)},
                  samples);
        }
    }
}

} // namespace ramus::render::caster::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
