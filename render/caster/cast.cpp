#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/caster/cast.cpp"
// clang-format off: foreach_target compiles this file once per instruction set and must come first.
#include <hwy/foreach_target.h>
// clang-format on
#include "render/caster/blended-inl.h"
#include "render/caster/cast.h"
#include "render/caster/cast_block-inl.h"
#include "render/scene/record_flags.h"

#include <algorithm>
#include <type_traits>

HWY_BEFORE_NAMESPACE();
namespace ramus::render::caster::HWY_NAMESPACE {

using namespace record;

alignas(64) constexpr std::uint32_t kLanePlace[16] = {0,
                                                      1,
                                                      2,
                                                      3,
                                                      kTile,
                                                      kTile + 1,
                                                      kTile + 2,
                                                      kTile + 3,
                                                      2 * kTile,
                                                      2 * kTile + 1,
                                                      2 * kTile + 2,
                                                      2 * kTile + 3,
                                                      3 * kTile,
                                                      3 * kTile + 1,
                                                      3 * kTile + 2,
                                                      3 * kTile + 3};

void CastTile(const View& view, const Field& field, const Cone* cones, const std::uint32_t* order, std::size_t count,
              bool with_values, int x, int y, Samples& samples) {
    for (int block = 0; block < kBlocks * kBlocks; ++block) {
        samples.farthest[block] = kNothing;
        samples.touched[block] = false; // what it holds is of another tile
    }
    constexpr float kHalf = 0.5F * kBlock;
    for (std::size_t i = 0; i < count; ++i) {
        const Cone& cone = cones[order[i]];
        // Blocks under the box around its outline.
        const float to_x = cone.pixel[0] + cone.length * cone.way[0], to_y = cone.pixel[1] + cone.length * cone.way[1];
        const auto first = [&](float a, float b, int corner) {
            const float low = (a < b ? a : b) - cone.reach - static_cast<float>(corner);
            return low <= 0.0F ? 0 : static_cast<int>(low >= float(kTile) ? float(kTile) : low) / kBlock;
        };
        const auto last = [&](float a, float b, int corner) {
            const float high = (a > b ? a : b) + cone.reach - static_cast<float>(corner);
            return high < 0.0F ? -1 : static_cast<int>(high >= float(kTile - 1) ? float(kTile - 1) : high) / kBlock;
        };
        const int x0 = first(cone.pixel[0], to_x, x), x1 = last(cone.pixel[0], to_x, x);
        const int y0 = first(cone.pixel[1], to_y, y), y1 = last(cone.pixel[1], to_y, y);
        for (int by = y0; by <= y1; ++by) {
            for (int bx = x0; bx <= x1; ++bx) {
                const int block = by * kBlocks + bx;
                const auto left = static_cast<float>(x + kBlock * bx), low = static_cast<float>(y + kBlock * by);
                if (!reaches(cone, left + kHalf, low + kHalf, samples.farthest[block])) continue;
                const auto cast = [&](auto flat) {
                    if (cone.contested)
                        CastContested<flat()>(view, field, cone, order[i], with_values, left, low, block, samples);
                    else
                        CastBlock<flat()>(view, cone, order[i], with_values, left, low, block, samples);
                };
                view.flat ? cast(std::true_type()) : cast(std::false_type());
            }
        }
    }
}

// One block of 16 pixels, lane by lane.
HWY_INLINE void ResolveLanes(const View& view, const Field& field, const Samples& samples, bool with_values, int block,
                             int lane, int x, int y, int left, int low, float* depths, float* picked,
                             std::uint32_t* ids, std::uint32_t* normals, Records& records) {
    const D d;
    const DU du;
    VU id[kSamples], normal[kSamples];
    V depth[kSamples];
    for (int s = 0; s < kSamples; ++s) {
        id[s] = hn::Load(du, samples.id[block][s] + lane);
        normal[s] = hn::Load(du, samples.normal[block][s] + lane);
        depth[s] = hn::Load(d, samples.depth[block][s] + lane);
    }
    V nearest = depth[0], solid = set(kNothing), mean_depth = depth[0];
    VU seen = id[0], seen_normal = normal[0], lines = id[0];
    M all = mask(hn::Ne(id[0], hn::Zero(du))), whole = all;
    V farthest = depth[0];
    for (int s = 1; s < kSamples; ++s) {
        const M nearer = hn::Lt(depth[s], nearest);
        seen = hn::IfThenElse(hn::RebindMask(du, nearer), id[s], seen);
        seen_normal = hn::IfThenElse(hn::RebindMask(du, nearer), normal[s], seen_normal);
        nearest = hn::Min(nearest, depth[s]);
        farthest = hn::Max(farthest, depth[s]);
        all = hn::And(all, mask(hn::Ne(id[s], hn::Zero(du))));
        lines = hn::Or(lines, id[s]);
        whole = hn::And(whole, mask(hn::Eq(id[s], id[0])));
        mean_depth = hn::Add(mean_depth, depth[s]);
    }
    solid = nearest;
    if (!hn::AllFalse(d, any_of(lines, kLine))) {
        solid = set(kNothing);
        for (int s = 0; s < kSamples; ++s)
            solid = hn::IfThenElse(any_of(id[s], kLine), solid, hn::Min(solid, depth[s]));
    }
    V3 mean{hn::Zero(d), hn::Zero(d), hn::Zero(d)};
    const M one_vessel = whole;
    if (!hn::AllFalse(d, all)) {
        const V3 first = unpacked_normal(normal[0]);
        mean = first;
        for (int s = 1; s < kSamples; ++s) {
            const V3 direction = unpacked_normal(normal[s]);
            whole = hn::And(whole, hn::Gt(dot(direction, first), set(0.7F)));
            mean = mean + direction;
        }
    }
    // Where the surface goes on through the pixel it is smooth, across creases of cones and from vessel to vessel.
    const M surface = hn::AndNot(any_of(lines, kLine | kSolid), all);
    const V pixel_mm = view.flat ? set(view.mm_a_pixel) : hn::Mul(set(view.mm_a_pixel), nearest);
    const M goes_on = hn::And(surface, hn::Or(whole, hn::Lt(hn::Sub(farthest, nearest), hn::Mul(set(3.0F), pixel_mm))));
    if (field.pieces != nullptr && !hn::AllFalse(d, goes_on)) {
        const Rays<V> rays = rays_at(view, static_cast<float>(x + left), static_cast<float>(y + low), lane, 0.5F, 0.5F);
        const V3 at = place_on(view, rays, hn::Mul(mean_depth, set(0.25F)));
        mean = Blended(field, goes_on, hn::Load(du, samples.cone[block] + lane), at, mean);
        whole = hn::Or(whole, hn::And(goes_on, one_vessel));
        const auto smooth = hn::RebindMask(du, goes_on);
        const VU packed = packed_normal(mean);
        for (VU& direction : normal) direction = hn::IfThenElse(smooth, packed, direction);
        seen_normal = hn::IfThenElse(smooth, packed, seen_normal);
    }
    hn::Store(solid, d, depths + lane);
    hn::Store(nearest, d, picked + lane);
    hn::Store(hn::AndNot(hn::Set(du, kLine), seen), du, ids + lane);
    hn::Store(seen_normal, du, normals + lane);

    const VU place =
        hn::Add(hn::Load(du, kLanePlace + lane), hn::Set(du, static_cast<std::uint32_t>(low * kTile + left)));
    const auto append = [&](M which, VU places, VU ids_of, VU normals_of, V depths_of, V values_of) {
        if (hn::AllFalse(d, which)) return;
        // Whole vectors, of which the next ones overwrite what does not count: storing only what counts is microcode
        // on some processors.
        const auto which_u = hn::RebindMask(du, which);
        const std::size_t n = records.count;
        hn::StoreU(hn::Compress(places, which_u), du, records.place + n);
        hn::StoreU(hn::Compress(ids_of, which_u), du, records.id + n);
        hn::StoreU(hn::Compress(normals_of, which_u), du, records.normal + n);
        hn::StoreU(hn::Compress(depths_of, which), d, records.depth + n);
        if (with_values) hn::StoreU(hn::Compress(values_of, which), d, records.value + n);
        records.count += hn::CountTrue(d, which);
    };
    const auto value = [&](int s) { return with_values ? hn::Load(d, samples.value[block][s] + lane) : hn::Zero(d); };
    append(whole, hn::Or(place, hn::Set(du, kWhole)), id[0], packed_normal(mean), hn::Mul(mean_depth, set(0.25F)),
           value(0));
    for (int s = 0; s < kSamples; ++s)
        append(hn::AndNot(whole, mask(hn::Ne(id[s], hn::Zero(du)))),
               hn::Or(place, hn::Set(du, static_cast<std::uint32_t>(s) << kSampleShift)), id[s], normal[s], depth[s],
               value(s));
}

void ResolveTile(const View& view, const Field& field, const Samples& samples, bool with_values, int x, int y,
                 const PictureArrays& picture, Records& records) {
    alignas(64) float depths[16], picked[16];
    alignas(64) std::uint32_t ids[16], normals[16];
    records.count = 0;
    for (int block = 0; block < kBlocks * kBlocks; ++block) {
        const int left = block % kBlocks * kBlock, low = block / kBlocks * kBlock;
        if (x + left >= view.width || y + low >= view.height) continue;
        const std::size_t corner = std::size_t(y + low) * std::size_t(view.stride) + std::size_t(x + left);
        if (!samples.touched[block]) {
            for (std::size_t at = corner; at < corner + kBlock * std::size_t(view.stride);
                 at += std::size_t(view.stride))
                for (std::size_t k = at; k < at + kBlock; ++k)
                    picture.depth[k] = picture.picked_depth[k] = kNothing, picture.id[k] = 0;
            continue;
        }
        for (int lane = 0; lane < 16; lane += kN)
            ResolveLanes(view, field, samples, with_values, block, lane, x, y, left, low, depths, picked, ids, normals,
                         records);
        for (int row = 0; row < kBlock; ++row) {
            const std::size_t to = corner + std::size_t(row) * std::size_t(view.stride);
            __builtin_memcpy(picture.depth + to, depths + kBlock * row, sizeof(float) * kBlock);
            __builtin_memcpy(picture.picked_depth + to, picked + kBlock * row, sizeof(float) * kBlock);
            __builtin_memcpy(picture.id + to, ids + kBlock * row, sizeof(std::uint32_t) * kBlock);
            __builtin_memcpy(picture.normal + to, normals + kBlock * row, sizeof(std::uint32_t) * kBlock);
        }
    }
}

} // namespace ramus::render::caster::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace ramus::render::caster {

HWY_EXPORT(CastTile);
HWY_EXPORT(ResolveTile);

void cast_tile(const View& view, const Field& field, const Cone* cones, const std::uint32_t* order, std::size_t count,
               bool with_values, int x, int y, Samples& samples) {
    HWY_DYNAMIC_DISPATCH(CastTile)(view, field, cones, order, count, with_values, x, y, samples);
}
void resolve_tile(const View& view, const Field& field, const Samples& samples, bool with_values, int x, int y,
                  const PictureArrays& picture, Records& records) {
    HWY_DYNAMIC_DISPATCH(ResolveTile)(view, field, samples, with_values, x, y, picture, records);
}

} // namespace ramus::render::caster
#endif
