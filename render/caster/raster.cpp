#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/caster/raster.cpp"
// clang-format off: foreach_target compiles this file once per instruction set and must come first.
#include <hwy/foreach_target.h>
// clang-format on
#include "render/caster/cast_block-inl.h"
#include "render/caster/coverage-inl.h"
#include "render/caster/raster.h"

HWY_BEFORE_NAMESPACE();
namespace ramus::render::caster::HWY_NAMESPACE {

template <bool Flat> HWY_INLINE void raster_block(const Triangle& t, const Block& block, Samples& samples) {
    const D d;
    const DU du;
    const int b = block.index;
    Float farthest = 0.0F;
    for (int lane = 0; lane < kBlockPixels; lane += kN) {
        bool any_covered = false;
        VU normal = hn::Zero(du);
        for (int sample = 0; sample < kSamples; ++sample) {
            float* depths = samples.depth[b][sample] + lane;
            const Float old = hn::Load(d, depths);
            const Coverage found = coverage<Flat>(t, block, lane, sample);
            const Mask nearer = found.covered && found.depth < old;
            farthest = max(farthest, select(nearer, found.depth, old));
            if (!any(nearer)) continue;
            if (!any_covered) normal = packed_normal(pixel_normal(t, block, lane));
            any_covered = true;
            hn::BlendedStore(found.depth.v, nearer.m, d, depths);
            const auto which = hn::RebindMask(du, nearer.m);
            hn::BlendedStore(hn::Set(du, t.id), which, du, samples.id[b][sample] + lane);
            hn::BlendedStore(normal, which, du, samples.normal[b][sample] + lane);
            if (block.tile.with_values) hn::BlendedStore(hn::Zero(d), nearer.m, d, samples.value[b][sample] + lane);
        }
    }
    samples.farthest[b] = hn::GetLane(hn::MaxOfLanes(d, farthest.v));
}

void raster_lanes(const TileTask& tile, const BlockTriangles& triangles, Samples& samples) {
    for (int index = 0; index < kBlocks * kBlocks; ++index) {
        const Block block = block_of(tile, index);
        for (std::uint32_t i = triangles.first[index]; i < triangles.first[index + 1]; ++i) {
            const Triangle& t = triangles.all[triangles.order[i]];
            clear_untouched(index, samples);
            if (tile.view.flat)
                raster_block<true>(t, block, samples);
            else
                raster_block<false>(t, block, samples);
        }
    }
}

} // namespace ramus::render::caster::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace ramus::render::caster {

HWY_EXPORT(raster_lanes);

void raster_tile(const TileTask& tile, const BlockTriangles& triangles, Samples& samples) {
    HWY_DYNAMIC_DISPATCH(raster_lanes)(tile, triangles, samples);
}

} // namespace ramus::render::caster
#endif
