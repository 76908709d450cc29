#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/caster/panes.cpp"
// clang-format off: foreach_target compiles this file once per instruction set and must come first.
#include <hwy/foreach_target.h>
// clang-format on
#include "render/caster/covering-inl.h"
#include "render/caster/meeting-inl.h"
#include "render/caster/owner-inl.h"
#include "render/caster/panes.h"
#include "render/scene/record_flags.h"

HWY_BEFORE_NAMESPACE();
namespace ramus::render::caster::HWY_NAMESPACE {

using namespace record;

// The stretches that one ray goes through cones, sorted by where they begin.
struct Stretches {
    float in[kMostPanes], out[kMostPanes];
    std::uint32_t id[kMostPanes], normal[kMostPanes]; // id 0: it comes from what is opaque, through no front
    int count;

    // Where there is no room, the farthest gives way.
    HWY_INLINE void insert(float from, float to, std::uint32_t of, std::uint32_t facing) {
        if (count == kMostPanes && in[kMostPanes - 1] <= from) return;
        int at = count < kMostPanes ? count++ : kMostPanes - 1;
        for (; at > 0 && in[at - 1] > from; --at)
            in[at] = in[at - 1], out[at] = out[at - 1], id[at] = id[at - 1], normal[at] = normal[at - 1];
        in[at] = from, out[at] = to, id[at] = of, normal[at] = facing;
    }
};

// Those of a block's samples and pixels.
struct Lists {
    Stretches of[kSamples][16];
    bool any = true; // something was inserted since clear()

    HWY_INLINE void clear() {
        if (!any) return;
        for (auto& sample : of)
            for (Stretches& list : sample) list.count = 0;
        any = false;
    }
    HWY_INLINE void insert(int sample, int lane, M which, V from, V to, VU ids, VU normals) {
        const D d;
        const DU du;
        alignas(64) float in[16], out[16], marks[16];
        alignas(64) std::uint32_t id[16], normal[16];
        hn::Store(from, d, in);
        hn::Store(to, d, out);
        hn::Store(hn::IfThenElseZero(which, set(1.0F)), d, marks);
        hn::Store(ids, du, id);
        hn::Store(normals, du, normal);
        for (int k = 0; k < kN; ++k)
            if (marks[k] != 0.0F) of[sample][lane + k].insert(in[k], out[k], id[k], normal[k]);
        any = true;
    }
};

// What a sample sees before anything opaque.
HWY_INLINE V opaque_depth(const Samples& samples, int block, int sample, int lane) {
    return samples.touched[block] ? hn::Load(D(), samples.depth[block][sample] + lane) : set(kNothing);
}

template <bool Flat>
HWY_INLINE void ListCone(const View& view, const Field& field, const Cone& cone, std::uint32_t number, float x, float y,
                         int block, const Samples& samples, Lists& lists) {
    const D d;
    const DU du;
    for (int lane = 0; lane < 16; lane += kN) {
        bool any = false; // normals are those at the pixels' middles, once there is a sample to have them
        VU normal = hn::Zero(du);
        for (int sample = 0; sample < kSamples; ++sample) {
            const Rays<V> rays = rays_of(view, x, y, lane, sample);
            const auto found = meet<Flat, true>(cone, rays);
            const M before = hn::And(found.there, hn::Lt(found.depth, opaque_depth(samples, block, sample, lane)));
            if (hn::AllFalse(d, before)) continue;
            if (!any) normal = packed_normal(facing<Flat>(cone, rays_at(view, x, y, lane, 0.5F, 0.5F)));
            any = true;
            VU id = hn::Set(du, cone.id);
            if (cone.contested) {
                const M own = OwnLeads(field, number, before, place_on(view, rays, found.depth));
                id = hn::IfThenElseZero(hn::RebindMask(du, own), id);
            }
            lists.insert(sample, lane, before, found.depth, found.out, id, normal);
        }
    }
}

template <bool Flat>
HWY_INLINE void ListTriangle(const Triangle& t, float x, float y, int block, const Samples& samples, Lists& lists) {
    const D d;
    const DU du;
    constexpr float kLeastShare = 0.004F; // of a pixel that a line takes
    for (int lane = 0; lane < 16; lane += kN) {
        bool any = false;
        VU normal = hn::Zero(du);
        M seen = hn::FirstN(d, 16);
        for (int sample = 0; sample < kSamples; ++sample) {
            const Covering found = covering<Flat>(t, x, y, lane, sample);
            const M before = hn::And(found.there, hn::Lt(found.depth, opaque_depth(samples, block, sample, lane)));
            if (hn::AllFalse(d, before)) continue;
            if (!any) {
                const V3 facing_there = facing(t, x, y, lane);
                const bool lines = t.half_width > 0.0F;
                normal = lines ? hn::BitCast(du, facing_there.x) : packed_normal(facing_there);
                if (lines) seen = hn::Ge(facing_there.x, set(kLeastShare));
            }
            any = true;
            lists.insert(sample, lane, hn::And(before, seen), found.depth, found.depth, hn::Set(du, t.id), normal);
        }
    }
}

// Leaves the places where the ray goes into glass or meets a shell. Of lesions and context each is one, wherever.
HWY_INLINE void keep_fronts(Stretches& list) {
    float inside_until = -kNothing;
    int kept = 0;
    for (int k = 0; k < list.count; ++k) {
        const bool shell = (list.id[k] & kSolid) != 0, enters = shell || list.in[k] > inside_until;
        if (!shell && list.out[k] > inside_until) inside_until = list.out[k];
        if (!enters || list.id[k] == 0) continue;
        list.in[kept] = list.in[k], list.id[kept] = list.id[k], list.normal[kept] = list.normal[k];
        ++kept;
    }
    list.count = kept;
}

// Whether all samples of a pixel see the same panes, which then are shaded once.
HWY_INLINE bool all_see_the_same(const Lists& lists, int lane) {
    const Stretches& first = lists.of[0][lane];
    for (int sample = 1; sample < kSamples; ++sample) {
        const Stretches& other = lists.of[sample][lane];
        if (other.count != first.count) return false;
        for (int k = 0; k < first.count; ++k)
            if (other.id[k] != first.id[k] || other.normal[k] != first.normal[k]) return false;
    }
    return true;
}

HWY_INLINE void add_pane(std::uint32_t place, std::uint32_t id, std::uint32_t normal, float depth, std::size_t at,
                         const PictureArrays& picture, Records& panes) {
    const std::size_t n = panes.count++;
    panes.place[n] = place;
    panes.id[n] = id;
    panes.normal[n] = normal;
    panes.depth[n] = depth;
    // A lesion is pointed at as if it were opaque, also through glass; context never is.
    const bool context = (id & kSolid) != 0 && (id & kContext) != 0, lesion = (id & kSolid) != 0 && !context;
    const std::uint32_t there = picture.id[at];
    const bool nearer_lesion = lesion && ((there & kSolid) == 0 || depth < picture.picked_depth[at]);
    if ((there != 0 || context) && !nearer_lesion) return;
    picture.id[at] = id;
    picture.picked_depth[at] = depth;
}

void ListPanes(const View& view, const Field& field, const Cone* cones, const std::uint32_t* order, std::size_t count,
               const BlockTriangles& triangles, int x, int y, const Samples& samples, const PictureArrays& picture,
               Records& panes) {
    panes.count = 0;
    Lists lists;
    constexpr float kHalf = 0.5F * kBlock;
    for (int block = 0; block < kBlocks * kBlocks; ++block) {
        const int left = block % kBlocks * kBlock, low = block / kBlocks * kBlock;
        if (x + left >= view.width || y + low >= view.height) continue;
        const auto fx = static_cast<float>(x + left), fy = static_cast<float>(y + low);
        lists.clear();
        for (std::size_t i = 0; i < count; ++i) {
            const Cone& cone = cones[order[i]];
            if (!reaches(cone, fx + kHalf, fy + kHalf, samples.farthest[block])) continue;
            if (view.flat)
                ListCone<true>(view, field, cone, order[i], fx, fy, block, samples, lists);
            else
                ListCone<false>(view, field, cone, order[i], fx, fy, block, samples, lists);
        }
        for (std::uint32_t i = triangles.first[block]; i < triangles.first[block + 1]; ++i) {
            const Triangle& t = triangles.all[triangles.order[i]];
            if (view.flat)
                ListTriangle<true>(t, fx, fy, block, samples, lists);
            else
                ListTriangle<false>(t, fx, fy, block, samples, lists);
        }
        if (!lists.any) continue;
        for (int lane = 0; lane < 16; ++lane) {
            const int column = left + lane % kBlock, row = low + lane / kBlock;
            const auto place = static_cast<std::uint32_t>(row * kTile + column);
            const std::size_t at = std::size_t(y + row) * std::size_t(view.stride) + std::size_t(x + column);
            for (auto& sample : lists.of) keep_fronts(sample[lane]);
            if (all_see_the_same(lists, lane)) {
                const Stretches& list = lists.of[0][lane];
                for (int k = 0; k < list.count; ++k) {
                    float depth = 0.0F;
                    for (const auto& sample : lists.of) depth += 0.25F * sample[lane].in[k];
                    add_pane(place | kWhole, list.id[k], list.normal[k], depth, at, picture, panes);
                }
                continue;
            }
            for (std::uint32_t sample = 0; sample < kSamples; ++sample) {
                const Stretches& list = lists.of[sample][lane];
                for (int k = 0; k < list.count; ++k)
                    add_pane(place | sample << kSampleShift, list.id[k], list.normal[k], list.in[k], at, picture,
                             panes);
            }
        }
    }
}

} // namespace ramus::render::caster::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace ramus::render::caster {

HWY_EXPORT(ListPanes);

void list_panes(const View& view, const Field& field, const Cone* cones, const std::uint32_t* order, std::size_t count,
                const BlockTriangles& triangles, int x, int y, const Samples& samples, const PictureArrays& picture,
                Records& panes) {
    HWY_DYNAMIC_DISPATCH(ListPanes)
    (view, field, cones, order, count, triangles, x, y, samples, picture, panes);
}

} // namespace ramus::render::caster
#endif
