#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/caster/panes.cpp"
// clang-format off: foreach_target compiles this file once per instruction set and must come first.
#include <hwy/foreach_target.h>
// clang-format on
#include "render/caster/covering-inl.h"
#include "render/caster/meeting-inl.h"
#include "render/caster/owner-inl.h"
#include "render/caster/panes.h"
#include "render/record_flags.h"

HWY_BEFORE_NAMESPACE();
namespace ramus::render::caster::HWY_NAMESPACE {

using namespace record;

constexpr int kN = int(hn::MaxLanes(D()));

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

// Where a triangle lies before what is opaque; whether it does anywhere.
HWY_INLINE bool insert_triangle(const View& view, const Triangle& t, float x, float y, int block, int sample,
                                const Samples& samples, Stretches (&lists)[16]) {
    const D d;
    constexpr float kLeastShare = 0.004F; // of a pixel that a line takes
    bool any = false;
    for (int lane = 0; lane < 16; lane += kN) {
        const Covering found =
            view.flat ? covering<true>(t, x, y, lane, sample) : covering<false>(t, x, y, lane, sample);
        const V opaque = samples.touched[block] ? hn::Load(d, samples.depth[block][sample] + lane) : set(kNothing);
        M before = hn::And(found.there, hn::Lt(found.depth, opaque));
        if (hn::AllFalse(d, before)) continue;
        const V3 normal = facing(t, x, y, lane);
        const bool lines = t.half_width > 0.0F;
        if (lines) before = hn::And(before, hn::Ge(normal.x, set(kLeastShare)));
        alignas(64) float depths[16], marks[16];
        alignas(64) std::uint32_t normals[16];
        hn::Store(found.depth, d, depths);
        hn::Store(lines ? hn::BitCast(DU(), normal.x) : packed_normal(normal), DU(), normals);
        hn::Store(hn::IfThenElseZero(before, set(1.0F)), d, marks);
        for (int k = 0; k < kN; ++k)
            if (marks[k] != 0.0F) lists[lane + k].insert(depths[k], depths[k], t.id, normals[k]), any = true;
    }
    return any;
}

void ListPanes(const View& view, const Field& field, const Cone* cones, const std::uint32_t* order, std::size_t count,
               const Listed<Triangle>& triangles, int x, int y, const Samples& samples, const PictureArrays& picture,
               std::uint32_t* near, Panes& panes) {
    const D d;
    const DU du;
    panes.count = 0;
    Stretches lists[16];
    alignas(64) float in[16], out[16];
    alignas(64) std::uint32_t normals[16], ids[16];
    constexpr float kHalf = 0.5F * kBlock;
    for (int block = 0; block < kBlocks * kBlocks; ++block) {
        const int left = block % kBlocks * kBlock, low = block / kBlocks * kBlock;
        if (x + left >= view.width || y + low >= view.height) continue;
        const auto fx = static_cast<float>(x + left), fy = static_cast<float>(y + low);
        std::size_t reaching = 0;
        for (std::size_t i = 0; i < count; ++i)
            if (reaches(cones[order[i]], fx + kHalf, fy + kHalf, samples.farthest[block])) near[reaching++] = order[i];
        std::uint32_t* const touching = near + reaching;
        std::size_t touching_count = 0;
        for (std::size_t i = 0; i < triangles.count; ++i)
            if (touches(triangles.all[triangles.order[i]], fx, fy)) touching[touching_count++] = triangles.order[i];
        for (int sample = 0; sample < kSamples && reaching + touching_count > 0; ++sample) {
            bool any = false;
            for (Stretches& list : lists) list.count = 0;
            for (std::size_t i = 0; i < reaching; ++i) {
                const Cone& cone = cones[near[i]];
                for (int lane = 0; lane < 16; lane += kN) {
                    const Rays<V> rays = rays_of(view, fx, fy, lane, sample);
                    const auto found = view.flat ? meet<true, true>(cone, rays) : meet<false, true>(cone, rays);
                    const M before =
                        hn::And(found.there, hn::Lt(found.depth, samples.touched[block]
                                                                     ? hn::Load(d, samples.depth[block][sample] + lane)
                                                                     : set(kNothing)));
                    if (hn::AllFalse(d, before)) continue;
                    any = true;
                    const Rays<V> middles = rays_at(view, fx, fy, lane, 0.5F, 0.5F);
                    const V3 normal = view.flat ? facing<true>(cone, middles) : facing<false>(cone, middles);
                    hn::Store(found.depth, d, in);
                    hn::Store(found.out, d, out);
                    hn::Store(packed_normal(normal), du, normals);
                    VU id = hn::Set(du, cone.id);
                    if (cone.contested) {
                        const M own = OwnLeads(field, near[i], before, place_on(view, rays, found.depth));
                        id = hn::IfThenElseZero(hn::RebindMask(du, own), id);
                    }
                    hn::Store(id, du, ids);
                    alignas(64) float marks[16];
                    hn::Store(hn::IfThenElseZero(before, set(1.0F)), d, marks);
                    for (int k = 0; k < kN; ++k)
                        if (marks[k] != 0.0F) lists[lane + k].insert(in[k], out[k], ids[k], normals[k]);
                }
            }
            for (std::size_t i = 0; i < touching_count; ++i)
                any = insert_triangle(view, triangles.all[touching[i]], fx, fy, block, sample, samples, lists) || any;
            if (!any) continue;
            for (int lane = 0; lane < 16; ++lane) {
                const Stretches& list = lists[lane];
                const int column = left + lane % kBlock, row = low + lane / kBlock;
                float inside_until = -kNothing;
                for (int k = 0; k < list.count; ++k) {
                    // Lesions and context are shells: a pane wherever one lies.
                    const bool shell = (list.id[k] & kSolid) != 0, context = shell && (list.id[k] & kContext) != 0;
                    const bool lesion = shell && !context;
                    const bool enters = shell || list.in[k] > inside_until;
                    if (!shell && list.out[k] > inside_until) inside_until = list.out[k];
                    if (!enters || list.id[k] == 0) continue;
                    const std::size_t n = panes.count++;
                    panes.place[n] = static_cast<std::uint32_t>(row * kTile + column) |
                                     static_cast<std::uint32_t>(sample) << kSampleShift;
                    panes.id[n] = list.id[k];
                    panes.normal[n] = list.normal[k];
                    panes.depth[n] = list.in[k];
                    const std::size_t at = std::size_t(y + row) * std::size_t(view.stride) + std::size_t(x + column);
                    const std::uint32_t there = picture.id[at];
                    // A lesion is pointed at as if it were opaque, also through glass.
                    const bool nearer_lesion =
                        lesion && ((there & kSolid) == 0 || list.in[k] < picture.picked_depth[at]);
                    if ((there == 0 && !context) || nearer_lesion) {
                        picture.id[at] = list.id[k];
                        picture.picked_depth[at] = list.in[k];
                    }
                }
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
                const Listed<Triangle>& triangles, int x, int y, const Samples& samples, const PictureArrays& picture,
                std::uint32_t* near, Panes& panes) {
    HWY_DYNAMIC_DISPATCH(ListPanes)
    (view, field, cones, order, count, triangles, x, y, samples, picture, near, panes);
}

} // namespace ramus::render::caster
#endif
