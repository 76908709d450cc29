#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/caster/fit.cpp"
// clang-format off: foreach_target compiles this file once per instruction set and must come first.
#include <hwy/foreach_target.h>
// clang-format on
#include "render/caster/fit.h"
#include "render/caster/near-inl.h"

HWY_BEFORE_NAMESPACE();
namespace ramus::render::caster::HWY_NAMESPACE {

constexpr int kWays = 16; // across a vessel
alignas(64) constexpr float kCosine[kWays] = {
    1.0F,  0.92387953F,  0.70710678F,  0.38268343F,  0.0F, -0.38268343F, -0.70710678F, -0.92387953F,
    -1.0F, -0.92387953F, -0.70710678F, -0.38268343F, 0.0F, 0.38268343F,  0.70710678F,  0.92387953F};
alignas(64) constexpr float kSine[kWays] = {
    0.0F, 0.38268343F,  0.70710678F,  0.92387953F,  1.0F,  0.92387953F,  0.70710678F,  0.38268343F,
    0.0F, -0.38268343F, -0.70710678F, -0.92387953F, -1.0F, -0.92387953F, -0.70710678F, -0.38268343F};

// How far the surface is along a way: the logarithm of a kernel is linear in the square of that, and of a few of them
// nearly.
HWY_INLINE V DistanceAlong(const Field& field, std::uint32_t near, V3 middle, V3 way, float radius, float least,
                           float most) {
    const D d;
    const float w = kernel::kNaturalLog * field.root_width * field.root_width;
    const auto inverse_root = kernel::set(kernel::PackTag<2>(), 1.0F / field.root_width);
    V distance = set(radius);
    for (int round = 0; round < 3; ++round) {
        V value = hn::Zero(d), slope = hn::Zero(d);
        for_pieces(field, field.near, field.first[near], field.first[near + 1], middle + distance * way,
                   [&](std::uint32_t, const kernel::Segments<2>& pair, const kernel::Foot<2>& foot) {
                       const kernel::KernelGradient<2> g = kernel::Gaussian::gradient<kernel::Ends::kSome>(
                           pair, foot, kernel::growth_of(pair, foot, inverse_root));
                       for (int s = 0; s < 2; ++s) {
                           const V radial = dot(way, {foot.qx.v[s], foot.qy.v[s], foot.qz.v[s]});
                           const V axial = dot(way, {pair.ux.v[s], pair.uy.v[s], pair.uz.v[s]});
                           value = hn::Add(value, g.value.v[s]);
                           slope = hn::MulAdd(g.radial.v[s], radial, hn::MulAdd(g.axial.v[s], axial, slope));
                       }
                   });
        const V log_value = hn::Mul(binary_logarithm(hn::Max(value, set(1e-12F))), set(0.69314718F));
        const V over = hn::Mul(hn::Add(log_value, set(w)), value);
        const V inward = hn::Min(slope, hn::Mul(set(-0.05F * w / radius), value));
        const V squared = hn::NegMulAdd(hn::Mul(set(2.0F), distance), hn::Div(over, hn::Min(inward, set(-1e-12F))),
                                        hn::Mul(distance, distance));
        const V lowest = set(least * radius), highest = set(most * radius);
        distance = hn::Sqrt(hn::Min(hn::Max(squared, hn::Mul(lowest, lowest)), hn::Mul(highest, highest)));
    }
    return distance;
}

void FitCircles(const Field& field, Across* places, std::size_t count) {
    const D d;
    for (Across* place = places; place < places + count; ++place) {
        V sum = hn::Zero(d), along_side = hn::Zero(d), along_up = hn::Zero(d);
        for (std::size_t k = 0; k < kWays; k += std::size_t(kN)) {
            const V cosine = hn::Load(d, kCosine + k), sine = hn::Load(d, kSine + k);
            const V3 way = cosine * set(place->side) + sine * set(place->up);
            const V distance =
                DistanceAlong(field, place->near, set(place->middle), way, place->radius, place->least, place->most);
            sum = hn::Add(sum, distance);
            along_side = hn::MulAdd(distance, cosine, along_side);
            along_up = hn::MulAdd(distance, sine, along_up);
        }
        const auto mean = [&](V v) { return hn::GetLane(hn::SumOfLanes(d, v)) / static_cast<float>(kWays); };
        place->radius = mean(sum);
        const float side = 2.0F * mean(along_side), up = 2.0F * mean(along_up);
        for (int i = 0; i < 3; ++i) place->middle[i] += side * place->side[i] + up * place->up[i];
    }
}

} // namespace ramus::render::caster::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace ramus::render::caster {

HWY_EXPORT(FitCircles);

void fit_circles(const Field& field, Across* places, std::size_t count) {
    HWY_DYNAMIC_DISPATCH(FitCircles)(field, places, count);
}

} // namespace ramus::render::caster
#endif
