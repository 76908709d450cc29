#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/caster/cast.cpp"
// clang-format off: foreach_target compiles this file once per instruction set and must come first.
#include <hwy/foreach_target.h>
// clang-format on
#include "render/caster/cast_block-inl.h"
#include "render/caster/field-inl.h"
#include "render/caster/intersection-inl.h"
#include "render/caster/stages.h"
#include "render/scene/record_flags.h"

HWY_BEFORE_NAMESPACE();
namespace ramus::render::caster::HWY_NAMESPACE {

using namespace record;

// The blocks of a row or column that [from, to] touches; `corner`: the tile's first pixel.
struct BlockRange {
    int first, last;
};
HWY_INLINE BlockRange blocks_touched(float from, float to, int corner) {
    const float low = from - static_cast<float>(corner), high = to - static_cast<float>(corner);
    return {low <= 0.0F ? 0 : static_cast<int>(low >= float(kTile) ? float(kTile) : low) / kBlock,
            high < 0.0F ? -1 : static_cast<int>(high >= float(kTile - 1) ? float(kTile - 1) : high) / kBlock};
}
// The blocks under the bounding box of the cone's outline; `axis`: 0 across, 1 up.
HWY_INLINE BlockRange blocks_under(const RoundCone& cone, int axis, int corner) {
    const float from = cone.image_from[axis], to = from + cone.image_length * cone.image_direction[axis];
    return blocks_touched((from < to ? from : to) - cone.image_half_width,
                          (from > to ? from : to) + cone.image_half_width, corner);
}

template <bool Flat> HWY_INLINE void cast_cones(const TileTask& tile, const TileCones& cones, Samples& samples) {
    for (std::size_t i = 0; i < cones.count; ++i) {
        const std::uint32_t number = cones.order[i];
        const RoundCone& cone = cones.all[number];
        const BlockRange across = blocks_under(cone, 0, tile.x), up = blocks_under(cone, 1, tile.y);
        for (int row = up.first; row <= up.last; ++row) {
            for (int column = across.first; column <= across.last; ++column) {
                const Block block = block_of(tile, row * kBlocks + column);
                if (!reaches(cone, block, samples.farthest[block.index])) continue;
                if (cone.near_other_layer)
                    cast_mixed_block<Flat>(block, cone, number, samples);
                else
                    cast_block<Flat>(block, cone, number, samples);
            }
        }
    }
}

void cast_lanes(const TileTask& tile, const TileCones& cones, Samples& samples) {
    for (int block = 0; block < kBlocks * kBlocks; ++block) {
        samples.farthest[block] = kNothing;
        samples.touched[block] = false; // its content belongs to another tile
    }
    if (tile.view.flat)
        cast_cones<true>(tile, cones, samples);
    else
        cast_cones<false>(tile, cones, samples);
}

// A vector of pixels of a block: a summary of their samples.
struct Pixels {
    VU id[kSamples], normal[kSamples];
    Float depth[kSamples];
    Float nearest, farthest, mean_depth;
    Float opaque;                  // nearest depth, except lines
    VU nearest_id, nearest_normal; // at the nearest sample
    VU all_bits;                   // of the ids of all samples
    Mask hit, one_surface;         // all samples are hit; all hits are of one surface
    Mask whole;                    // both, with similar normals: shaded as one
    Vec3 normal_sum;               // of the samples
};

HWY_INLINE void load(const Samples& samples, int block, int lane, Pixels& p) {
    const D d;
    const DU du;
    for (int s = 0; s < kSamples; ++s) {
        p.id[s] = hn::Load(du, samples.id[block][s] + lane);
        p.normal[s] = hn::Load(du, samples.normal[block][s] + lane);
        p.depth[s] = hn::Load(d, samples.depth[block][s] + lane);
    }
    p.nearest = p.farthest = p.depth[0];
    p.nearest_id = p.all_bits = p.id[0];
    p.nearest_normal = p.normal[0];
    p.hit = p.one_surface = Uint{p.id[0]} != 0U;
    Float sum = p.depth[0];
    for (int s = 1; s < kSamples; ++s) {
        const auto nearer = hn::RebindMask(du, (p.depth[s] < p.nearest).m);
        p.nearest_id = hn::IfThenElse(nearer, p.id[s], p.nearest_id);
        p.nearest_normal = hn::IfThenElse(nearer, p.normal[s], p.nearest_normal);
        p.nearest = min(p.nearest, p.depth[s]);
        p.farthest = max(p.farthest, p.depth[s]);
        p.hit = p.hit && Uint{p.id[s]} != 0U;
        p.all_bits = hn::Or(p.all_bits, p.id[s]);
        p.one_surface = p.one_surface && Mask{mask(hn::Eq(p.id[s], p.id[0]))};
        sum = sum + p.depth[s];
    }
    p.mean_depth = 0.25F * sum;
    p.opaque = p.nearest;
    if (any(has({p.all_bits}, kLine))) {
        p.opaque = kNothing;
        for (int s = 0; s < kSamples; ++s)
            p.opaque = select(has({p.id[s]}, kLine), p.opaque, min(p.opaque, p.depth[s]));
    }
    p.whole = p.one_surface;
    p.normal_sum = Vec3(0.0F);
    if (!any(p.hit)) return;
    const Vec3 first = unpacked_normal(p.normal[0]);
    p.normal_sum = first;
    for (int s = 1; s < kSamples; ++s) {
        const Vec3 normal = unpacked_normal(p.normal[s]);
        p.whole = p.whole && dot(normal, first) > 0.7F;
        p.normal_sum = p.normal_sum + normal;
    }
}

// Mean square distance of a pixel's samples from its middle, in x and in y.
constexpr float spread_of(const float (&at)[kSamples]) {
    float sum = 0.0F;
    for (const float x : at) sum += (x - 0.5F) * (x - 0.5F) / kSamples;
    return sum;
}
constexpr float kSpread = spread_of(kSampleX);
static_assert(kSpread == spread_of(kSampleY));

// Smooths normals across creases of cones and from vessel to vessel, where one surface covers the whole pixel.
HWY_INLINE void smooth_with_field(const Block& block, int lane, const Samples& samples, Pixels& p) {
    const TileTask& tile = block.tile;
    const DU du;
    const Mask surface = p.hit && !has({p.all_bits}, kLine | kSolid);
    const Float pixel_mm = tile.view.flat ? Float(tile.view.mm_a_pixel) : tile.view.mm_a_pixel * p.nearest;
    const Mask on_surface = surface && (p.whole || p.farthest - p.nearest < 3.0F * pixel_mm);
    if (tile.field.segments == nullptr || !any(on_surface)) return;
    const VU cones = hn::Load(du, samples.cone[block.index] + lane);
    const Mask goes_on = on_surface && Uint{cones} != kNoCone; // triangles have smooth normals already
    if (!any(goes_on)) return;
    const Rays<Float> middle = pixel_rays(block, lane);
    const Vec3 sight = tile.view.flat ? Vec3(0.0F, 0.0F, 1.0F) : normalize(Vec3(middle.x, middle.y, 1.0F));
    const SeenPoints seen{point_on(tile.view, middle, p.mean_depth), sight, kSpread * pixel_mm * pixel_mm};
    p.normal_sum = field_normals(tile.field, goes_on, cones, seen, p.normal_sum);
    p.whole = p.whole || (goes_on && p.one_surface);
    const auto smooth = hn::RebindMask(du, goes_on.m);
    const VU packed = packed_normal(p.normal_sum);
    for (VU& normal : p.normal) normal = hn::IfThenElse(smooth, packed, normal);
    p.nearest_normal = hn::IfThenElse(smooth, packed, p.nearest_normal);
}

struct RecordLanes {
    VU position, id, normal;
    Float depth, value;
};

// Stores whole vectors, which the next ones partly overwrite: masked stores are microcode on some processors.
HWY_INLINE void append(Mask which, const RecordLanes& lanes, Records& records) {
    const D d;
    const DU du;
    if (!any(which)) return;
    const auto which_u = hn::RebindMask(du, which.m);
    const std::size_t n = records.count;
    hn::StoreU(hn::Compress(lanes.position, which_u), du, records.position + n);
    hn::StoreU(hn::Compress(lanes.id, which_u), du, records.id + n);
    hn::StoreU(hn::Compress(lanes.normal, which_u), du, records.normal + n);
    hn::StoreU(hn::Compress(lanes.depth.v, which.m), d, records.depth + n);
    if (records.value != nullptr) hn::StoreU(hn::Compress(lanes.value.v, which.m), d, records.value + n);
    records.count += hn::CountTrue(d, which.m);
}

// One record per pixel that shows one surface, one per hit sample of other pixels.
HWY_INLINE void append(const Block& block, int lane, const Samples& samples, const Pixels& p, Records& records) {
    const DU du;
    // A block covers four rows of the tile.
    const VU in_block = hn::Iota(du, static_cast<std::uint32_t>(lane));
    const VU row = hn::ShiftRight<2>(in_block), column = hn::And(in_block, hn::Set(du, std::uint32_t{kBlock - 1}));
    static_assert(kBlock == 4 && kTile == 32);
    const int corner = block.index / kBlocks * kBlock * kTile + block.index % kBlocks * kBlock;
    const VU position =
        hn::Add(hn::Add(hn::ShiftLeft<5>(row), column), hn::Set(du, static_cast<std::uint32_t>(corner)));
    const auto value = [&](int s) {
        return records.value != nullptr ? hn::Load(D(), samples.value[block.index][s] + lane) : hn::Zero(D());
    };
    append(p.whole,
           {hn::Or(position, hn::Set(du, kWhole)), p.id[0], packed_normal(p.normal_sum), p.mean_depth, value(0)},
           records);
    for (int s = 0; s < kSamples; ++s) {
        const VU sample = hn::Set(du, static_cast<std::uint32_t>(s) << kSampleShift);
        append(Uint{p.id[s]} != 0U && !p.whole, {hn::Or(position, sample), p.id[s], p.normal[s], p.depth[s], value(s)},
               records);
    }
}

// Copies the rows of a complete block into the picture.
template <class Value> HWY_INLINE void store_rows(const Value* block, std::size_t stride, Value* to) {
    for (std::size_t row = 0; row < kBlock; ++row)
        __builtin_memcpy(to + row * stride, block + row * kBlock, sizeof(Value) * kBlock);
}

void resolve_lanes(const TileTask& tile, const Samples& samples, const PictureArrays& picture, Records& records) {
    alignas(64) float opaque[kBlockPixels], nearest[kBlockPixels];
    alignas(64) std::uint32_t ids[kBlockPixels], normals[kBlockPixels];
    records.count = 0;
    const View& view = tile.view;
    const auto stride = static_cast<std::size_t>(view.stride);
    for (int index = 0; index < kBlocks * kBlocks; ++index) {
        const int x = tile.x + index % kBlocks * kBlock, y = tile.y + index / kBlocks * kBlock;
        if (x >= view.width || y >= view.height) continue;
        const std::size_t corner = std::size_t(y) * stride + std::size_t(x);
        if (!samples.touched[index]) {
            for (std::size_t at = corner; at < corner + kBlock * stride; at += stride)
                for (std::size_t k = at; k < at + kBlock; ++k)
                    picture.depth[k] = picture.picked_depth[k] = kNothing, picture.id[k] = 0;
            continue;
        }
        const Block block = block_of(tile, index);
        for (int lane = 0; lane < kBlockPixels; lane += kN) {
            Pixels p;
            load(samples, index, lane, p);
            smooth_with_field(block, lane, samples, p);
            hn::Store(p.opaque.v, D(), opaque + lane);
            hn::Store(p.nearest.v, D(), nearest + lane);
            hn::Store(hn::AndNot(hn::Set(DU(), kLine), p.nearest_id), DU(), ids + lane);
            hn::Store(p.nearest_normal, DU(), normals + lane);
            append(block, lane, samples, p, records);
        }
        store_rows(opaque, stride, picture.depth + corner);
        store_rows(nearest, stride, picture.picked_depth + corner);
        store_rows(ids, stride, picture.id + corner);
        store_rows(normals, stride, picture.normal + corner);
    }
}

template <bool Flat> HWY_INLINE void raster_block(const Triangle& t, const Block& block, Samples& samples) {
    const D d;
    const DU du;
    const int b = block.index;
    Float farthest = 0.0F;
    for (int lane = 0; lane < kBlockPixels; lane += kN) {
        Coverage found[kSamples];
        Mask nearer[kSamples], seen = {hn::FirstN(d, 0)};
        for (int s = 0; s < kSamples; ++s) {
            const Float old = hn::Load(d, samples.depth[b][s] + lane);
            found[s] = coverage<Flat>(t, block, lane, s);
            nearer[s] = found[s].covered && found[s].depth < old;
            seen = seen || nearer[s];
            farthest = max(farthest, select(nearer[s], found[s].depth, old));
        }
        if (!any(seen)) continue;
        const VU normal = packed_normal(pixel_normal(t, block, lane));
        for (int s = 0; s < kSamples; ++s) {
            const auto which = hn::RebindMask(du, nearer[s].m);
            hn::BlendedStore(found[s].depth.v, nearer[s].m, d, samples.depth[b][s] + lane);
            hn::BlendedStore(hn::Set(du, t.id), which, du, samples.id[b][s] + lane);
            hn::BlendedStore(normal, which, du, samples.normal[b][s] + lane);
            if (s == 0) hn::BlendedStore(hn::Set(du, kNoCone), which, du, samples.cone[b] + lane);
            if (block.tile.with_values) hn::BlendedStore(hn::Zero(d), nearer[s].m, d, samples.value[b][s] + lane);
        }
    }
    samples.farthest[b] = hn::GetLane(hn::MaxOfLanes(d, farthest.v));
}

void raster_lanes(const TileTask& tile, const BlockTriangles& triangles, Samples& samples) {
    for (int index = 0; index < kBlocks * kBlocks; ++index) {
        const Block block = block_of(tile, index);
        for (const std::uint32_t* i = triangles.first[index]; i < triangles.first[index + 1]; ++i) {
            const Triangle& t = triangles.all[*i];
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

HWY_EXPORT(cast_lanes);
HWY_EXPORT(resolve_lanes);

void cast_tile(const TileTask& tile, const TileCones& cones, Samples& samples) {
    HWY_DYNAMIC_DISPATCH(cast_lanes)(tile, cones, samples);
}
void resolve_tile(const TileTask& tile, const Samples& samples, const PictureArrays& picture, Records& records) {
    HWY_DYNAMIC_DISPATCH(resolve_lanes)(tile, samples, picture, records);
}

HWY_EXPORT(raster_lanes);

void raster_tile(const TileTask& tile, const BlockTriangles& triangles, Samples& samples) {
    HWY_DYNAMIC_DISPATCH(raster_lanes)(tile, triangles, samples);
}

} // namespace ramus::render::caster
#endif
