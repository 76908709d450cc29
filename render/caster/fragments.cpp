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

constexpr std::uint32_t kNoCone = ~0U;

// The stretches of one ray inside cones, sorted by where they begin.
struct RayIntervals {
    float entry[kMaxFragments], exit[kMaxFragments];
    std::uint32_t id[kMaxFragments], normal[kMaxFragments]; // id 0: from what is opaque, through no front
    std::uint32_t cone[kMaxFragments];                      // kNoCone: of a triangle
    int count;

    HWY_INLINE void copy(int from, int to) {
        entry[to] = entry[from], exit[to] = exit[from], id[to] = id[from], normal[to] = normal[from];
        cone[to] = cone[from];
    }
    // When it is full, the farthest gives way.
    HWY_INLINE void insert(float from, float to, std::uint32_t of, std::uint32_t facing, std::uint32_t number) {
        if (count == kMaxFragments && entry[kMaxFragments - 1] <= from) return;
        put(count < kMaxFragments ? count++ : kMaxFragments - 1, from, to, of, facing, number);
    }
    // At its place among those before `at`, which go on by one; `at` itself is free.
    HWY_INLINE void put(int at, float from, float to, std::uint32_t of, std::uint32_t facing, std::uint32_t number) {
        for (; at > 0 && entry[at - 1] > from; --at) copy(at - 1, at);
        entry[at] = from, exit[at] = to, id[at] = of, normal[at] = facing, cone[at] = number;
    }
};

// Of a vector of rays.
struct IntervalLanes {
    Mask where;
    Float entry, exit;
    VU id, normal;
};

// Those of a block's samples and pixels.
struct BlockIntervals {
    RayIntervals of[kSamples][kBlockPixels];
    bool any = true; // something was inserted since clear()

    HWY_INLINE void clear() {
        if (!any) return;
        for (auto& sample : of)
            for (RayIntervals& ray : sample) ray.count = 0;
        any = false;
    }
    HWY_INLINE void insert(int sample, int lane, const IntervalLanes& lanes, std::uint32_t cone) {
        const D d;
        const DU du;
        alignas(64) float entry[kBlockPixels], exit[kBlockPixels], marks[kBlockPixels];
        alignas(64) std::uint32_t id[kBlockPixels], normal[kBlockPixels];
        hn::Store(lanes.entry.v, d, entry);
        hn::Store(lanes.exit.v, d, exit);
        hn::Store(select(lanes.where, 1.0F, 0.0F).v, d, marks);
        hn::Store(lanes.id, du, id);
        hn::Store(lanes.normal, du, normal);
        for (int k = 0; k < kN; ++k)
            if (marks[k] != 0.0F) of[sample][lane + k].insert(entry[k], exit[k], id[k], normal[k], cone);
        any = true;
    }
};

// What a sample sees before anything opaque.
HWY_INLINE Float opaque_depth(const Samples& samples, int block, int sample, int lane) {
    return samples.touched[block] ? Float(hn::Load(D(), samples.depth[block][sample] + lane)) : Float(kNothing);
}

template <bool Flat>
HWY_INLINE void insert_cone(const Block& block, const RoundCone& cone, std::uint32_t number, const Samples& samples,
                            BlockIntervals& intervals) {
    const DU du;
    for (int lane = 0; lane < kBlockPixels; lane += kN) {
        bool any_hit = false; // normals are those at the pixels' middles, once there is a sample to have them
        VU normal = hn::Zero(du);
        for (int sample = 0; sample < kSamples; ++sample) {
            const Rays<Float> rays = sample_rays(block, lane, sample);
            const auto found = intersect<Flat, true>(cone, rays);
            const Mask before = found.hit && found.depth < opaque_depth(samples, block.index, sample, lane);
            if (!any(before)) continue;
            if (!any_hit) normal = packed_normal(pixel_normal<Flat>(cone, pixel_rays(block, lane)));
            any_hit = true;
            VU id = hn::Set(du, cone.id);
            if (cone.near_other_layer) {
                const Vec3 at = point_on(block.tile.view, rays, found.depth);
                const Mask own = own_layer_leads(block.tile.field, number, before, at);
                id = hn::IfThenElseZero(hn::RebindMask(du, own.m), id);
            }
            intervals.insert(sample, lane, {before, found.depth, found.exit, id, normal}, number);
        }
    }
}

template <bool Flat>
HWY_INLINE void insert_triangle(const Block& block, const Triangle& t, const Samples& samples,
                                BlockIntervals& intervals) {
    const DU du;
    constexpr float kLeastShare = 0.004F; // of a pixel that a line takes
    for (int lane = 0; lane < kBlockPixels; lane += kN) {
        bool any_covered = false;
        VU normal = hn::Zero(du);
        Mask seen = {hn::FirstN(D(), kBlockPixels)};
        for (int sample = 0; sample < kSamples; ++sample) {
            const Coverage found = coverage<Flat>(t, block, lane, sample);
            const Mask before = found.covered && found.depth < opaque_depth(samples, block.index, sample, lane);
            if (!any(before)) continue;
            if (!any_covered) {
                const Vec3 facing = pixel_normal(t, block, lane);
                const bool lines = t.half_width > 0.0F;
                normal = lines ? hn::BitCast(du, facing.x.v) : packed_normal(facing);
                if (lines) seen = facing.x >= kLeastShare;
            }
            any_covered = true;
            intervals.insert(sample, lane, {before && seen, found.depth, found.depth, hn::Set(du, t.id), normal},
                             kNoCone);
        }
    }
}

template <bool Flat>
HWY_INLINE void find_intervals(const Block& block, const TileCones& cones, const BlockTriangles& triangles,
                               const Samples& samples, BlockIntervals& intervals) {
    intervals.clear();
    for (std::size_t i = 0; i < cones.count; ++i) {
        const RoundCone& cone = cones.all[cones.order[i]];
        if (reaches(cone, block, samples.farthest[block.index]))
            insert_cone<Flat>(block, cone, cones.order[i], samples, intervals);
    }
    for (const std::uint32_t* i = triangles.first[block.index]; i < triangles.first[block.index + 1]; ++i)
        insert_triangle<Flat>(block, triangles.all[*i], samples, intervals);
}

// Whether two cones that overlap are of one vessel there, or of vessels that are joined: then one adds to the other's
// surface.
HWY_INLINE bool are_joined(const Field& field, std::uint32_t a, std::uint32_t b) {
    if (a == b || a == kNoCone || b == kNoCone || field.segments == nullptr) return true;
    const auto has = [&](std::uint32_t cone, std::uint32_t other) {
        for (std::uint32_t n = field.first[cone]; n < field.first[cone + 1]; ++n)
            if (field.neighbours[n] == other) return true;
        return false;
    };
    return has(a, b) || has(b, a);
}

// What of a ray's stretches it is in.
struct OpenIntervals {
    float exit[kMaxFragments];
    std::uint32_t cone[kMaxFragments];
    int count = 0;

    // Where the ray enters a cone's vessel that it comes to at `from`; kNothing: it is in there already. Where it is in
    // another vessel that only presses on it, a wall parts the two half-way through what both claim.
    HWY_INLINE float front(const Field& field, float from, float to, std::uint32_t number) const {
        float farthest = from;
        for (int k = 0; k < count; ++k) {
            if (exit[k] < from) continue;
            if (are_joined(field, cone[k], number)) return kNothing;
            farthest = exit[k] > farthest ? exit[k] : farthest;
        }
        return to > farthest ? 0.5F * (from + farthest) : from;
    }
};

// Leaves those where the ray goes into glass or meets a shell. Of lesions and context each is one, wherever.
HWY_INLINE void keep_fronts(RayIntervals& ray, const Field& field) {
    OpenIntervals open;
    int kept = 0;
    for (int k = 0; k < ray.count; ++k) {
        const bool shell = (ray.id[k] & kSolid) != 0;
        const float from = ray.entry[k], to = ray.exit[k];
        const std::uint32_t cone = ray.cone[k];
        const float front = shell ? from : open.front(field, from, to, cone);
        if (!shell) open.exit[open.count] = to, open.cone[open.count++] = cone;
        if (front < kNothing && ray.id[k] != 0) ray.put(kept++, front, to, ray.id[k], ray.normal[k], cone);
    }
    ray.count = kept;
}

// Whether all samples of a pixel see the same fragments, which then are shaded once.
HWY_INLINE bool all_see_the_same(const BlockIntervals& intervals, int lane) {
    const RayIntervals& first = intervals.of[0][lane];
    for (int sample = 1; sample < kSamples; ++sample) {
        const RayIntervals& other = intervals.of[sample][lane];
        if (other.count != first.count) return false;
        for (int k = 0; k < first.count; ++k)
            if (other.id[k] != first.id[k] || other.normal[k] != first.normal[k]) return false;
    }
    return true;
}

// Appends number k of the ray. `position`: as of records; `at`: of the pixel in the picture.
HWY_INLINE void add_fragment(const RayIntervals& ray, int k, float depth, std::uint32_t position, std::size_t at,
                             const PictureArrays& picture, Records& fragments) {
    const std::size_t n = fragments.count++;
    const std::uint32_t id = ray.id[k];
    fragments.position[n] = position;
    fragments.id[n] = id;
    fragments.normal[n] = ray.normal[k];
    fragments.depth[n] = depth;
    // A lesion is pointed at as if it were opaque, also through glass; context never is.
    const bool context = (id & kSolid) != 0 && (id & kContext) != 0, lesion = (id & kSolid) != 0 && !context;
    const std::uint32_t picked = picture.id[at];
    const bool nearer_lesion = lesion && ((picked & kSolid) == 0 || depth < picture.picked_depth[at]);
    if ((picked != 0 || context) && !nearer_lesion) return;
    picture.id[at] = id;
    picture.picked_depth[at] = depth;
}

// Of one pixel of a block.
HWY_INLINE void add_pixel(BlockIntervals& intervals, const Field& field, int lane, std::uint32_t position,
                          std::size_t at, const PictureArrays& picture, Records& fragments) {
    for (auto& sample : intervals.of) keep_fronts(sample[lane], field);
    if (all_see_the_same(intervals, lane)) {
        const RayIntervals& ray = intervals.of[0][lane];
        for (int k = 0; k < ray.count; ++k) {
            float depth = 0.0F;
            for (const auto& sample : intervals.of) depth += 0.25F * sample[lane].entry[k];
            add_fragment(ray, k, depth, position | kWhole, at, picture, fragments);
        }
        return;
    }
    for (std::uint32_t sample = 0; sample < kSamples; ++sample) {
        const RayIntervals& ray = intervals.of[sample][lane];
        for (int k = 0; k < ray.count; ++k)
            add_fragment(ray, k, ray.entry[k], position | sample << kSampleShift, at, picture, fragments);
    }
}

void list_fragment_lanes(const TileTask& tile, const TileCones& cones, const BlockTriangles& triangles,
                         const Samples& samples, const PictureArrays& picture, Records& fragments) {
    fragments.count = 0;
    BlockIntervals intervals;
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
            add_pixel(intervals, tile.field, lane, static_cast<std::uint32_t>(row * kTile + column), at, picture,
                      fragments);
        }
    }
}

} // namespace ramus::render::caster::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace ramus::render::caster {

HWY_EXPORT(list_fragment_lanes);

void list_fragments(const TileTask& tile, const TileCones& cones, const BlockTriangles& triangles,
                    const Samples& samples, const PictureArrays& picture, Records& fragments) {
    HWY_DYNAMIC_DISPATCH(list_fragment_lanes)(tile, cones, triangles, samples, picture, fragments);
}

} // namespace ramus::render::caster
#endif
