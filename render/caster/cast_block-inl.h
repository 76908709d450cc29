// Casts the samples of one block at one opaque cone and keeps the nearest hit. Included once per instruction set.
#if defined(RAMUS_CASTER_CAST_BLOCK_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef RAMUS_CASTER_CAST_BLOCK_INL_H
#undef RAMUS_CASTER_CAST_BLOCK_INL_H
#else
#define RAMUS_CASTER_CAST_BLOCK_INL_H
#endif

#include "render/caster/field-inl.h"
#include "render/caster/intersection-inl.h"
#include "render/scene/record_flags.h"

HWY_BEFORE_NAMESPACE();
namespace ramus::render::caster::HWY_NAMESPACE {

// Blocks are cleared on first use: until then a block holds samples of an earlier tile.
HWY_INLINE void clear_untouched(int block, Samples& samples) {
    if (samples.touched[block]) return;
    samples.touched[block] = true;
    for (int sample = 0; sample < kSamples; ++sample)
        for (int lane = 0; lane < kBlockPixels; lane += kN) {
            hn::Store(set(kNothing), D(), samples.depth[block][sample] + lane);
            hn::Store(hn::Zero(DU()), DU(), samples.id[block][sample] + lane);
        }
}

// One sample's hit on a cone, for a vector of pixels.
struct Hit {
    Mask where;
    Float depth; // of all lanes, hit or not
    Float along; // position along the cone's axis, 0 to 1
    VU normal;
};

// `number`: index of the cone.
HWY_INLINE void write(const Block& block, const RoundCone& cone, std::uint32_t number, int sample, int lane,
                      const Hit& hit, Samples& samples) {
    const D d;
    const DU du;
    const auto where = hn::RebindMask(du, hit.where.m);
    const auto put = [&](std::uint32_t* to, VU value) {
        hn::Store(hn::IfThenElse(where, value, hn::Load(du, to + lane)), du, to + lane);
    };
    const int b = block.index;
    hn::Store(hit.depth.v, d, samples.depth[b][sample] + lane);
    put(samples.id[b][sample], hn::Set(du, cone.id));
    if (sample == 0) put(samples.cone[b], hn::Set(du, number));
    put(samples.normal[b][sample], hit.normal);
    if (!block.tile.with_values) return;
    float* values = samples.value[b][sample] + lane;
    const Float value = mix(cone.value[0], cone.value[1], hit.along);
    hn::Store(select(hit.where, value, hn::Load(d, values)).v, d, values);
}

// Handles two samples at a time (see FloatPair).
template <bool Flat>
HWY_INLINE void cast_block(const Block& block, const RoundCone& cone, std::uint32_t number, Samples& samples) {
    const D d;
    clear_untouched(block.index, samples);
    const bool has_light = (cone.id & record::kLine) == 0;
    Float farthest = 0.0F;
    for (int lane = 0; lane < kBlockPixels; lane += kN) {
        const Rays<Float> middle = pixel_rays(block, lane);
        for (int sample = 0; sample < kSamples; sample += 2) {
            const auto depths = [&](int s) { return Float(hn::Load(d, samples.depth[block.index][s] + lane)); };
            const Rays<Float> first = sample_rays(block, lane, sample), second = sample_rays(block, lane, sample + 1);
            const Rays<FloatPair> rays{{first.x, second.x}, {first.y, second.y}};
            const auto found = intersect<Flat, false>(cone, rays);
            const FloatPair old{depths(sample), depths(sample + 1)};
            const MaskPair nearer = found.hit && found.depth < old;
            if (!any(nearer)) {
                farthest = max(farthest, max(old.a, old.b));
                continue;
            }
            const FloatPair now = select(nearer, found.depth, old);
            farthest = max(farthest, max(now.a, now.b));
            VU facing_a = hn::Zero(DU()), facing_b = facing_a; // the eye
            if (has_light) {
                const auto normal =
                    sample_normal<Flat>(cone, rays, Rays<FloatPair>{middle.x, middle.y}, found.depth, found.along);
                facing_a = packed_normal({normal.x.a, normal.y.a, normal.z.a});
                facing_b = packed_normal({normal.x.b, normal.y.b, normal.z.b});
            }
            write(block, cone, number, sample, lane, {nearer.a, now.a, found.along.a, facing_a}, samples);
            write(block, cone, number, sample + 1, lane, {nearer.b, now.b, found.along.b, facing_b}, samples);
        }
    }
    samples.farthest[block.index] = hn::GetLane(hn::MaxOfLanes(d, farthest.v));
}

// For a cone some of whose neighbours are glass. Where the vessel continues as glass, the cone is open: the eye sees
// the inside of its far wall. That wall gets a normal towards the eye, so that it looks like a lid.
template <bool Flat>
HWY_INLINE void cast_mixed_block(const Block& block, const RoundCone& cone, std::uint32_t number, Samples& samples) {
    const TileTask& tile = block.tile;
    clear_untouched(block.index, samples);
    for (int lane = 0; lane < kBlockPixels; lane += kN) {
        for (int sample = 0; sample < kSamples; ++sample) {
            const Rays<Float> rays = sample_rays(block, lane, sample);
            const auto found = intersect<Flat, true>(cone, rays);
            const Float old = hn::Load(D(), samples.depth[block.index][sample] + lane);
            const Mask before = found.hit && found.depth < old;
            if (!any(before)) continue;
            const auto own = [&](Mask which, Float depth) {
                return own_layer_leads(tile.field, number, which, point_on(tile.view, rays, depth));
            };
            const Mask front = own(before, found.depth), open = before && found.exit < old && !front;
            const Mask lid = any(open) ? own(open, found.exit) : open, seen = front || lid;
            const Float depth = select(seen, select(lid, found.exit, found.depth), old);
            const auto front_normal =
                sample_normal<Flat>(cone, rays, pixel_rays(block, lane), found.depth, found.along);
            const Vec3 normal =
                select(lid, Vec3(0.0F, 0.0F, 1.0F), Vec3(front_normal.x, front_normal.y, front_normal.z));
            write(block, cone, number, sample, lane, {seen, depth, found.along, packed_normal(normal)}, samples);
        }
    }
}

} // namespace ramus::render::caster::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
