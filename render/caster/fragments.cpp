#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/caster/fragments.cpp"
// clang-format off: foreach_target compiles this file once per instruction set and must come first.
#include <hwy/foreach_target.h>
// clang-format on
#include "render/caster/field-inl.h"
#include "render/caster/intersection-inl.h"
#include "render/caster/stages.h"
#include "render/scene/record_flags.h"

HWY_BEFORE_NAMESPACE();
namespace ramus::render::caster::HWY_NAMESPACE {

using namespace record;

// The intervals of one ray inside cones, sorted by their start.
struct RayIntervals {
    float entry[kMaxFragments], exit[kMaxFragments];
    std::uint32_t id[kMaxFragments], normal[kMaxFragments]; // id 0: starts at an opaque surface, without a front
    std::uint32_t cone[kMaxFragments];                      // kNoCone: a triangle
    int count;

    HWY_INLINE void copy(int from, int to) {
        entry[to] = entry[from], exit[to] = exit[from], id[to] = id[from], normal[to] = normal[from];
        cone[to] = cone[from];
    }
    // Drops the farthest interval if full.
    HWY_INLINE void insert(float from, float to, std::uint32_t of, std::uint32_t facing, std::uint32_t number) {
        if (count == kMaxFragments && entry[kMaxFragments - 1] <= from) return;
        put(count < kMaxFragments ? count++ : kMaxFragments - 1, from, to, of, facing, number);
    }
    // Inserts in order before `at`, which is free; moves the later ones by one.
    HWY_INLINE void put(int at, float from, float to, std::uint32_t of, std::uint32_t facing, std::uint32_t number) {
        for (; at > 0 && entry[at - 1] > from; --at) copy(at - 1, at);
        entry[at] = from, exit[at] = to, id[at] = of, normal[at] = facing, cone[at] = number;
    }
};

// The intervals of a vector of rays.
struct IntervalLanes {
    Mask where;
    Float entry, exit;
    VU id, normal;
};

// The intervals of a block's rays.
struct BlockIntervals {
    RayIntervals of[kSamples][kBlockPixels];
    bool in_pairs;   // one ray per two samples, in the first half of `of`; false: one per sample
    bool any = true; // something was inserted since clear()

    [[nodiscard]] HWY_INLINE int rays() const { return in_pairs ? kSamples / 2 : kSamples; }
    [[nodiscard]] HWY_INLINE float right(int ray) const { return in_pairs ? kPairX[ray] : kSampleX[ray]; }
    [[nodiscard]] HWY_INLINE float up(int ray) const { return in_pairs ? kPairY[ray] : kSampleY[ray]; }
    // Depth of the nearest opaque surface at any of the ray's samples.
    [[nodiscard]] HWY_INLINE Float opaque_depth(const Samples& samples, int block, int ray, int lane) const {
        if (!samples.touched[block]) return kNothing;
        const auto of_sample = [&](int s) { return Float(hn::Load(D(), samples.depth[block][s] + lane)); };
        return in_pairs ? min(of_sample(2 * ray), of_sample(2 * ray + 1)) : of_sample(ray);
    }

    HWY_INLINE void clear() {
        if (!any) return;
        for (int k = 0; k < rays(); ++k)
            for (RayIntervals& ray : of[k]) ray.count = 0;
        any = false;
    }
    HWY_INLINE void insert(int ray, int lane, const IntervalLanes& lanes, std::uint32_t cone) {
        const D d;
        const DU du;
        alignas(64) float entry[kBlockPixels], exit[kBlockPixels];
        alignas(64) std::uint32_t id[kBlockPixels], normal[kBlockPixels];
        hn::Store(lanes.entry.v, d, entry);
        hn::Store(lanes.exit.v, d, exit);
        hn::Store(lanes.id, du, id);
        hn::Store(lanes.normal, du, normal);
        // Few rays of a block meet a thin vessel.
        std::uint8_t bytes[8] = {};
        hn::StoreMaskBits(d, lanes.where.m, bytes);
        for (std::uint32_t left = bytes[0] | std::uint32_t{bytes[1]} << 8U; left != 0; left &= left - 1) {
            const int k = __builtin_ctz(left);
            of[ray][lane + k].insert(entry[k], exit[k], id[k], normal[k], cone);
        }
        any = true;
    }
};

template <bool Flat>
HWY_INLINE void insert_cone(const Block& block, const RoundCone& cone, std::uint32_t number, const Samples& samples,
                            BlockIntervals& intervals) {
    const DU du;
    for (int lane = 0; lane < kBlockPixels; lane += kN) {
        bool any_hit = false; // normals are evaluated at the pixels' middles, only if a sample is hit
        VU normal = hn::Zero(du);
        const auto insert = [&](int ray, const Rays<Float>& rays, Mask hit, Float depth, Float exit) {
            const Mask before = hit && depth < intervals.opaque_depth(samples, block.index, ray, lane);
            if (!any(before)) return;
            if (!any_hit) normal = packed_normal(pixel_normal<Flat>(cone, pixel_rays(block, lane)));
            any_hit = true;
            VU id = hn::Set(du, cone.id);
            if (cone.near_other_layer) {
                const Vec3 at = point_on(block.tile.view, rays, depth);
                const Mask own = own_layer_leads(block.tile.field, number, before, at);
                id = hn::IfThenElseZero(hn::RebindMask(du, own.m), id);
            }
            intervals.insert(ray, lane, {before, depth, exit, id, normal}, number);
        };
        const auto rays_of = [&](int ray) { return rays_at(block, lane, intervals.right(ray), intervals.up(ray)); };
        for (int ray = 0; ray < intervals.rays(); ray += 2) { // two at a time
            const Rays<Float> first = rays_of(ray), second = rays_of(ray + 1);
            const auto found = intersect<Flat, true>(cone, Rays<FloatPair>{{first.x, second.x}, {first.y, second.y}});
            if (!any(found.hit)) continue;
            insert(ray, first, found.hit.a, found.depth.a, found.exit.a);
            insert(ray + 1, second, found.hit.b, found.depth.b, found.exit.b);
        }
    }
}

template <bool Flat>
HWY_INLINE void insert_triangle(const Block& block, const Triangle& t, const Samples& samples,
                                BlockIntervals& intervals) {
    const DU du;
    constexpr float kLeastShare = 0.004F; // smallest visible share of a pixel covered by a line
    for (int lane = 0; lane < kBlockPixels; lane += kN) {
        bool any_covered = false;
        VU normal = hn::Zero(du);
        Mask seen = {hn::FirstN(D(), kBlockPixels)};
        for (int ray = 0; ray < intervals.rays(); ++ray) {
            const Coverage found = coverage_at<Flat>(t, block, lane, intervals.right(ray), intervals.up(ray));
            const Mask before = found.covered && found.depth < intervals.opaque_depth(samples, block.index, ray, lane);
            if (!any(before)) continue;
            if (!any_covered) {
                const Vec3 facing = pixel_normal(t, block, lane);
                const bool lines = t.half_width > 0.0F;
                normal = lines ? hn::BitCast(du, facing.x.v) : packed_normal(facing);
                if (lines) seen = facing.x >= kLeastShare;
            }
            any_covered = true;
            intervals.insert(ray, lane, {before && seen, found.depth, found.depth, hn::Set(du, t.id), normal}, kNoCone);
        }
    }
}

template <bool Flat>
HWY_INLINE void find_intervals(const Block& block, const BlockCones& cones, const BlockTriangles& triangles,
                               const Samples& samples, BlockIntervals& intervals) {
    intervals.clear();
    for (const std::uint32_t* i = cones.first[block.index]; i < cones.first[block.index + 1]; ++i) {
        const RoundCone& cone = cones.all[*i];
        if (reaches(cone, block, samples.farthest[block.index])) insert_cone<Flat>(block, cone, *i, samples, intervals);
    }
    for (const std::uint32_t* i = triangles.first[block.index]; i < triangles.first[block.index + 1]; ++i)
        insert_triangle<Flat>(block, triangles.all[*i], samples, intervals);
}

// Whether two overlapping cones belong to one vessel or to connected vessels: then one contributes to the other's
// surface.
HWY_INLINE bool are_joined(const Field& field, std::uint32_t a, std::uint32_t b) {
    if (field.segments == nullptr) return true;
    const auto has = [&](std::uint32_t cone, std::uint32_t other) {
        for (std::uint32_t n = field.first[cone]; n < field.first[cone + 1]; ++n)
            if (field.neighbours[n] == other) return true;
        return false;
    };
    return has(a, b) || has(b, a);
}

// Caches are_joined() per pair: adjacent rays meet the same cones.
class JoinedCones {
public:
    explicit HWY_INLINE JoinedCones(const Field& field) : field_(field) {
        for (Pair& pair : pairs_) pair = {kNoCone, kNoCone, false};
    }
    HWY_INLINE bool operator()(std::uint32_t a, std::uint32_t b) {
        if (a == b || a == kNoCone || b == kNoCone) return true;
        Pair& pair = pairs_[(a * 0x9e3779b1U ^ b * 0x85ebca6bU) >> 22U];
        if (pair.a != a || pair.b != b) pair = {a, b, are_joined(field_, a, b)};
        return pair.joined;
    }

private:
    struct Pair {
        std::uint32_t a, b;
        bool joined;
    };
    const Field& field_;
    Pair pairs_[1024];
};

// The intervals that contain the current point of a ray.
struct OpenIntervals {
    float exit[kMaxFragments];
    std::uint32_t cone[kMaxFragments];
    int count = 0;

    // Returns where the ray enters the vessel of a cone whose interval starts at `from`; calls must be in order of
    // `from`. kNothing: it is inside the vessel already. In a vessel that only presses on another one, the wall is
    // halfway through the overlap.
    HWY_INLINE float front(JoinedCones& joined, float from, float to, std::uint32_t number) {
        int left = 0;
        for (int k = 0; k < count; ++k)
            if (exit[k] >= from) exit[left] = exit[k], cone[left++] = cone[k];
        count = left;
        float farthest = from;
        for (int k = count - 1; k >= 0; --k) {
            if (joined(cone[k], number)) return kNothing;
            farthest = exit[k] > farthest ? exit[k] : farthest;
        }
        return to > farthest ? 0.5F * (from + farthest) : from;
    }
};

// Keeps the intervals at which the ray enters glass or meets a shell. Every interval of lesions and context is kept.
HWY_INLINE void keep_fronts(RayIntervals& ray, JoinedCones& joined) {
    OpenIntervals open;
    int kept = 0;
    for (int k = 0; k < ray.count; ++k) {
        const bool shell = (ray.id[k] & kSolid) != 0;
        const float from = ray.entry[k], to = ray.exit[k];
        const std::uint32_t cone = ray.cone[k];
        const float front = shell ? from : open.front(joined, from, to, cone);
        if (!shell) open.exit[open.count] = to, open.cone[open.count++] = cone;
        if (front < kNothing && ray.id[k] != 0) ray.put(kept++, front, to, ray.id[k], ray.normal[k], cone);
    }
    ray.count = kept;
}

// Whether all rays of a pixel see the same fragments, so that shading once suffices.
HWY_INLINE bool all_see_the_same(const BlockIntervals& intervals, int lane) {
    const RayIntervals& first = intervals.of[0][lane];
    for (int r = 1; r < intervals.rays(); ++r) {
        const RayIntervals& other = intervals.of[r][lane];
        if (other.count != first.count) return false;
        for (int k = 0; k < first.count; ++k)
            if (other.id[k] != first.id[k] || other.normal[k] != first.normal[k]) return false;
    }
    return true;
}

// Appends interval k of the ray. `position`: as in Records; `at`: the pixel's index in the picture.
HWY_INLINE void add_fragment(const RayIntervals& ray, int k, float depth, std::uint32_t position, std::size_t at,
                             const PictureArrays& picture, Records& fragments) {
    const std::size_t n = fragments.count++;
    const std::uint32_t id = ray.id[k];
    fragments.position[n] = position;
    fragments.id[n] = id;
    fragments.normal[n] = ray.normal[k];
    fragments.depth[n] = depth;
    // Lesions are picked as if opaque, also through glass; context is never picked.
    const bool context = (id & kSolid) != 0 && (id & kContext) != 0, lesion = (id & kSolid) != 0 && !context;
    const std::uint32_t picked = picture.id[at];
    const bool nearer_lesion = lesion && ((picked & kSolid) == 0 || depth < picture.picked_depth[at]);
    if ((picked != 0 || context) && !nearer_lesion) return;
    picture.id[at] = id;
    picture.picked_depth[at] = depth;
}

// Adds the fragments of one pixel of a block.
HWY_INLINE void add_pixel(BlockIntervals& intervals, JoinedCones& joined, int lane, std::uint32_t position,
                          std::size_t at, const PictureArrays& picture, Records& fragments) {
    const int rays = intervals.rays();
    for (int r = 0; r < rays; ++r) keep_fronts(intervals.of[r][lane], joined);
    if (all_see_the_same(intervals, lane)) {
        const RayIntervals& ray = intervals.of[0][lane];
        for (int k = 0; k < ray.count; ++k) {
            float depth = 0.0F;
            for (int r = 0; r < rays; ++r) depth += intervals.of[r][lane].entry[k];
            add_fragment(ray, k, depth / static_cast<float>(rays), position | kWhole, at, picture, fragments);
        }
        return;
    }
    for (int r = 0; r < rays; ++r) {
        const RayIntervals& ray = intervals.of[r][lane];
        const auto sample = static_cast<std::uint32_t>(intervals.in_pairs ? 2 * r : r);
        const std::uint32_t seen_by = position | sample << kSampleShift | (intervals.in_pairs ? kPair : 0U);
        for (int k = 0; k < ray.count; ++k) add_fragment(ray, k, ray.entry[k], seen_by, at, picture, fragments);
    }
}

void list_fragment_lanes(const TileTask& tile, const BlockCones& cones, const BlockTriangles& triangles,
                         const Samples& samples, bool in_pairs, const PictureArrays& picture, Records& fragments) {
    fragments.count = 0;
    BlockIntervals intervals;
    intervals.in_pairs = in_pairs;
    JoinedCones joined(tile.field);
    for (int index = 0; index < kBlocks * kBlocks; ++index) {
        const int left = index % kBlocks * kBlock, low = index / kBlocks * kBlock;
        if (tile.x + left >= tile.view.width || tile.y + low >= tile.view.height) continue;
        const Block block = block_of(tile, index);
        if (tile.view.flat)
            find_intervals<true>(block, cones, triangles, samples, intervals);
        else
            find_intervals<false>(block, cones, triangles, samples, intervals);
        if (!intervals.any) continue;
        for (int lane = 0; lane < kBlockPixels; ++lane) {
            const int column = left + lane % kBlock, row = low + lane / kBlock;
            const std::size_t at =
                std::size_t(tile.y + row) * std::size_t(tile.view.stride) + std::size_t(tile.x + column);
            add_pixel(intervals, joined, lane, static_cast<std::uint32_t>(row * kTile + column), at, picture,
                      fragments);
        }
    }
}

} // namespace ramus::render::caster::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace ramus::render::caster {

HWY_EXPORT(list_fragment_lanes);

void list_fragments(const TileTask& tile, const BlockCones& cones, const BlockTriangles& triangles,
                    const Samples& samples, bool in_pairs, const PictureArrays& picture, Records& fragments) {
    HWY_DYNAMIC_DISPATCH(list_fragment_lanes)(tile, cones, triangles, samples, in_pairs, picture, fragments);
}

} // namespace ramus::render::caster
#endif
