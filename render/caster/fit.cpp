#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/caster/fit.cpp"
// clang-format off: foreach_target compiles this file once per instruction set and must come first.
#include <hwy/foreach_target.h>
// clang-format on
#include "render/caster/fit.h"
#include "render/caster/local_field-inl.h"

HWY_BEFORE_NAMESPACE();
namespace ramus::render::caster::HWY_NAMESPACE {

constexpr int kDirections = 16; // across a vessel
alignas(64) constexpr float kCosine[kDirections] = {
    1.0F,  0.92387953F,  0.70710678F,  0.38268343F,  0.0F, -0.38268343F, -0.70710678F, -0.92387953F,
    -1.0F, -0.92387953F, -0.70710678F, -0.38268343F, 0.0F, 0.38268343F,  0.70710678F,  0.92387953F};
alignas(64) constexpr float kSine[kDirections] = {
    0.0F, 0.38268343F,  0.70710678F,  0.92387953F,  1.0F,  0.92387953F,  0.70710678F,  0.38268343F,
    0.0F, -0.38268343F, -0.70710678F, -0.92387953F, -1.0F, -0.92387953F, -0.70710678F, -0.38268343F};

// How far the surface is from `middle`: the logarithm of a kernel is linear in the square of that, and of a few of them
// nearly.
HWY_INLINE Float surface_distance(const Field& field, const CrossSection& section, Vec3 middle, Vec3 direction) {
    const float w = kernel::kNaturalLog * field.root_width * field.root_width, radius = section.radius;
    const float least = section.least * radius, most = section.most * radius;
    const auto inverse_root = kernel::set(kernel::PackTag<2>(), 1.0F / field.root_width);
    Float distance = radius;
    for (int round = 0; round < 3; ++round) {
        Float value = 0.0F, slope = 0.0F;
        for_neighbours(field, field.neighbours, field.first[section.segment], field.first[section.segment + 1],
                       middle + distance * direction,
                       [&](std::uint32_t, const kernel::Segments<2>& pair, const kernel::Foot<2>& foot) {
                           const kernel::KernelGradient<2> g = kernel::Gaussian::gradient<kernel::Ends::kSome>(
                               pair, foot, kernel::growth_of(pair, foot, inverse_root));
                           for (int s = 0; s < 2; ++s) {
                               const Float radial = dot(direction, {foot.qx.v[s], foot.qy.v[s], foot.qz.v[s]});
                               const Float axial = dot(direction, {pair.ux.v[s], pair.uy.v[s], pair.uz.v[s]});
                               value = value + g.value.v[s];
                               slope = mad(g.radial.v[s], radial, mad(g.axial.v[s], axial, slope));
                           }
                       });
        const Float over = (log(max(value, 1e-12F)) + w) * value;
        const Float inward = min(slope, -0.05F * w / radius * value);
        const Float squared = distance * distance - 2.0F * distance * (over / min(inward, -1e-12F));
        distance = sqrt(clamp(squared, least * least, most * most));
    }
    return distance;
}

void fit_circle_lanes(const Field& field, CrossSection* sections, std::size_t count) {
    const D d;
    for (CrossSection* section = sections; section < sections + count; ++section) {
        const auto vector = [](const float* v) { return Vec3(v[0], v[1], v[2]); };
        Float sum = 0.0F, along_side = 0.0F, along_up = 0.0F;
        for (std::size_t k = 0; k < kDirections; k += std::size_t(kN)) {
            const Float cosine = hn::Load(d, kCosine + k), sine = hn::Load(d, kSine + k);
            const Vec3 direction = cosine * vector(section->side) + sine * vector(section->up);
            const Float distance = surface_distance(field, *section, vector(section->middle), direction);
            sum = sum + distance;
            along_side = mad(distance, cosine, along_side);
            along_up = mad(distance, sine, along_up);
        }
        const auto mean = [&](Float f) {
            return hn::GetLane(hn::SumOfLanes(d, f.v)) / static_cast<float>(kDirections);
        };
        section->radius = mean(sum);
        const float side = 2.0F * mean(along_side), up = 2.0F * mean(along_up);
        for (int i = 0; i < 3; ++i) section->middle[i] += side * section->side[i] + up * section->up[i];
    }
}

} // namespace ramus::render::caster::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace ramus::render::caster {

HWY_EXPORT(fit_circle_lanes);

void fit_circles(const Field& field, CrossSection* sections, std::size_t count) {
    HWY_DYNAMIC_DISPATCH(fit_circle_lanes)(field, sections, count);
}

} // namespace ramus::render::caster
#endif
