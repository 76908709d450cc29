// Whose a place of the surface is where glass meets what is opaque: that branch's which adds most to the field there,
// as in the mesh. Included once per instruction set.
#if defined(RAMUS_CASTER_OWNER_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef RAMUS_CASTER_OWNER_INL_H
#undef RAMUS_CASTER_OWNER_INL_H
#else
#define RAMUS_CASTER_OWNER_INL_H
#endif

#include "render/caster/near-inl.h"

HWY_BEFORE_NAMESPACE();
namespace ramus::render::caster::HWY_NAMESPACE {

// The largest of the sums that branches have at a place.
struct Leading {
    static constexpr int kMost = 8; // branches; more hardly meet
    std::uint32_t branches[kMost];
    V sums[kMost];
    int count = 0;

    HWY_INLINE void add(std::uint32_t branch, V value) {
        int i = 0;
        while (i < count && branches[i] != branch) ++i;
        if (i == kMost) return;
        if (i == count) branches[count] = branch, sums[count++] = hn::Zero(D());
        sums[i] = hn::Add(sums[i], value);
    }
    [[nodiscard]] HWY_INLINE V most() const {
        V most = hn::Zero(D());
        for (int i = 0; i < count; ++i) most = hn::Max(most, sums[i]);
        return most;
    }
};

// Whether the places `at` that rays met `cone` at, `which` of them, belong to a branch of its layer.
HWY_INLINE M OwnLeads(const Field& field, std::uint32_t cone, M which, V3 at) {
    const D d;
    Leading rivals, own;
    for_pieces(field, field.rivals, field.first_rival[cone], field.first_rival[cone + 1], at,
               [&](std::uint32_t i, const kernel::Segments<2>& pair, const kernel::Foot<2>& foot) {
                   const kernel::Pack<2> value = kernel::Gaussian::value<kernel::Ends::kSome>(pair, foot);
                   for (std::uint32_t s = 0; s < 2; ++s) rivals.add(field.branch[field.rivals[i + s]], value.v[s]);
               });
    const V rival = rivals.most();
    // Who leads on the surface has a good share of the isovalue.
    const M doubtful = hn::And(which, hn::Gt(rival, set(0.25F * field.isovalue)));
    if (hn::AllFalse(d, doubtful)) return which;
    for_pieces(field, field.near, field.first[cone], field.first[cone + 1], at,
               [&](std::uint32_t i, const kernel::Segments<2>& pair, const kernel::Foot<2>& foot) {
                   const V closest = hn::Min(foot.rho.v[0], foot.rho.v[1]);
                   const V reach = set(kernel::kFadeEndScaled);
                   if (hn::AllFalse(d, hn::And(doubtful, hn::Lt(closest, reach)))) return;
                   const kernel::Pack<2> value = kernel::Gaussian::value<kernel::Ends::kSome>(pair, foot);
                   for (std::uint32_t s = 0; s < 2; ++s) {
                       const std::uint32_t piece = field.near[i + s];
                       if (field.layer[piece] == field.layer[cone]) own.add(field.branch[piece], value.v[s]);
                   }
               });
    return hn::AndNot(hn::And(doubtful, hn::Lt(own.most(), rival)), which);
}

} // namespace ramus::render::caster::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
