// Which layer a point of the surface belongs to where glass meets what is opaque: that of the branch that adds most to
// the field there, as in the mesh. Included once per instruction set.
#if defined(RAMUS_CASTER_STRONGEST_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef RAMUS_CASTER_STRONGEST_INL_H
#undef RAMUS_CASTER_STRONGEST_INL_H
#else
#define RAMUS_CASTER_STRONGEST_INL_H
#endif

#include "render/caster/local_field-inl.h"

HWY_BEFORE_NAMESPACE();
namespace ramus::render::caster::HWY_NAMESPACE {

// What each branch adds to the field at a point.
struct BranchSums {
    static constexpr int kMax = 8; // branches; more hardly meet
    std::uint32_t branches[kMax];
    V sums[kMax];
    int count = 0;

    HWY_INLINE void add(std::uint32_t branch, V value) {
        int i = 0;
        while (i < count && branches[i] != branch) ++i;
        if (i == kMax) return;
        if (i == count) branches[count] = branch, sums[count++] = hn::Zero(D());
        sums[i] = hn::Add(sums[i], value);
    }
    [[nodiscard]] HWY_INLINE Float largest() const {
        V largest = hn::Zero(D());
        for (int i = 0; i < count; ++i) largest = hn::Max(largest, sums[i]);
        return largest;
    }
};

// Those of the points `at` where rays hit `cone`, `which` of them, that belong to a branch of its layer.
HWY_INLINE Mask own_layer_leads(const Field& field, std::uint32_t cone, Mask which, Vec3 at) {
    BranchSums others, own;
    for_neighbours(field, field.other_layer, field.first_other[cone], field.first_other[cone + 1], at,
                   [&](std::uint32_t i, const kernel::Segments<2>& pair, const kernel::Foot<2>& foot) {
                       const kernel::Pack<2> value = kernel::Gaussian::value<kernel::Ends::kSome>(pair, foot);
                       for (std::uint32_t s = 0; s < 2; ++s)
                           others.add(field.branch[field.other_layer[i + s]], value.v[s]);
                   });
    const Float other = others.largest();
    // Who leads on the surface has a good share of the isovalue.
    const Mask doubtful = which && other > 0.25F * field.isovalue;
    if (!any(doubtful)) return which;
    for_neighbours(field, field.neighbours, field.first[cone], field.first[cone + 1], at,
                   [&](std::uint32_t i, const kernel::Segments<2>& pair, const kernel::Foot<2>& foot) {
                       const Float closest = hn::Min(foot.rho.v[0], foot.rho.v[1]);
                       if (!any(doubtful && closest < kernel::kFadeEndScaled)) return;
                       const kernel::Pack<2> value = kernel::Gaussian::value<kernel::Ends::kSome>(pair, foot);
                       for (std::uint32_t s = 0; s < 2; ++s) {
                           const std::uint32_t segment = field.neighbours[i + s];
                           if (field.layer[segment] == field.layer[cone]) own.add(field.branch[segment], value.v[s]);
                       }
                   });
    return which && !(doubtful && own.largest() < other);
}

} // namespace ramus::render::caster::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
