#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/caster/raster.cpp"
// clang-format off: foreach_target compiles this file once per instruction set and must come first.
#include <hwy/foreach_target.h>
// clang-format on
#include "render/caster/cast_block-inl.h"
#include "render/caster/covering-inl.h"
#include "render/caster/raster.h"

HWY_BEFORE_NAMESPACE();
namespace ramus::render::caster::HWY_NAMESPACE {

template <bool Flat>
HWY_INLINE void RasterBlock(const Triangle& t, bool with_values, float x, float y, int block, Samples& samples) {
    const D d;
    const DU du;
    V farthest = hn::Zero(d);
    for (int lane = 0; lane < 16; lane += kN) {
        bool any = false;
        VU normal = hn::Zero(du);
        for (int sample = 0; sample < kSamples; ++sample) {
            float* depths = samples.depth[block][sample] + lane;
            const V old = hn::Load(d, depths);
            const Covering found = covering<Flat>(t, x, y, lane, sample);
            const M nearer = hn::And(found.there, hn::Lt(found.depth, old));
            farthest = hn::Max(farthest, hn::IfThenElse(nearer, found.depth, old));
            if (hn::AllFalse(d, nearer)) continue;
            if (!any) normal = packed_normal(facing(t, x, y, lane));
            any = true;
            hn::BlendedStore(found.depth, nearer, d, depths);
            const auto which = hn::RebindMask(du, nearer);
            hn::BlendedStore(hn::Set(du, t.id), which, du, samples.id[block][sample] + lane);
            hn::BlendedStore(normal, which, du, samples.normal[block][sample] + lane);
            if (with_values) hn::BlendedStore(hn::Zero(d), nearer, d, samples.value[block][sample] + lane);
        }
    }
    samples.farthest[block] = hn::GetLane(hn::MaxOfLanes(d, farthest));
}

void RasterTile(const View& view, const BlockTriangles& triangles, bool with_values, int x, int y, Samples& samples) {
    for (int block = 0; block < kBlocks * kBlocks; ++block) {
        const auto left = static_cast<float>(x + block % kBlocks * kBlock);
        const auto low = static_cast<float>(y + block / kBlocks * kBlock);
        for (std::uint32_t i = triangles.first[block]; i < triangles.first[block + 1]; ++i) {
            const Triangle& t = triangles.all[triangles.order[i]];
            Touch(block, samples);
            if (view.flat)
                RasterBlock<true>(t, with_values, left, low, block, samples);
            else
                RasterBlock<false>(t, with_values, left, low, block, samples);
        }
    }
}

} // namespace ramus::render::caster::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace ramus::render::caster {

HWY_EXPORT(RasterTile);

void raster_tile(const View& view, const BlockTriangles& triangles, bool with_values, int x, int y, Samples& samples) {
    HWY_DYNAMIC_DISPATCH(RasterTile)(view, triangles, with_values, x, y, samples);
}

} // namespace ramus::render::caster
#endif
