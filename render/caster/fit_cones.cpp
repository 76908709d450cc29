// Fits cones to the convolution surface, which is not quite centred on bent lines, and thinner at free ends. Done once
// for all pictures.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/caster/fit_cones.cpp"
// clang-format off: foreach_target compiles this file once per instruction set and must come first.
#include <hwy/foreach_target.h>
// clang-format on
#include "render/caster/field-inl.h"
#include "render/caster/fitted_cones.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>
#include <tbb/parallel_for.h>

HWY_BEFORE_NAMESPACE();
namespace ramus::render::caster::HWY_NAMESPACE {

constexpr int kDirections = 16; // around a cross-section
alignas(64) constexpr float kCosine[kDirections] = {
    1.0F,  0.92387953F,  0.70710678F,  0.38268343F,  0.0F, -0.38268343F, -0.70710678F, -0.92387953F,
    -1.0F, -0.92387953F, -0.70710678F, -0.38268343F, 0.0F, 0.38268343F,  0.70710678F,  0.92387953F};
alignas(64) constexpr float kSine[kDirections] = {
    0.0F, 0.38268343F,  0.70710678F,  0.92387953F,  1.0F,  0.92387953F,  0.70710678F,  0.38268343F,
    0.0F, -0.38268343F, -0.70710678F, -0.92387953F, -1.0F, -0.92387953F, -0.70710678F, -0.38268343F};

// Distance of the surface from `middle`: the logarithm of a kernel is linear in the squared distance, and that of a sum
// of few kernels nearly so.
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

void fit_circles(const Field& field, CrossSection* sections, std::size_t count) {
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

HWY_EXPORT(fit_circles);

namespace {

// Bounds of the fit, in radii of the vessel. Next to another vessel the circle would also enclose that vessel, which
// has its own cones. Tuned for the least difference from the picture at rest, on grown trees.
constexpr float kLeast = 0.9F, kMost = 1.03F;

// The ball at a free end, in radii: its radius, and the distance of its centre from the end. It passes through the tip
// of the surface, `beyond` the end, and around the end like the surface, whose radius there is sqrt(1 - 1 / width):
// exp(-w d^2) / 2 is the isovalue exp(-w), and w = width ln 2.
struct Tip {
    float radius, before;
};
Tip tip_of(float width, float beyond) {
    if (width <= 0.0F) return {1.0F, 1.0F - beyond};
    const float at_end = 1.0F - 1.0F / width, reach = std::max(beyond, 0.05F);
    const float radius = std::min(0.5F * (at_end / reach + reach), 1.0F);
    return {radius, radius - beyond};
}

// Vertices of the mesh are on the surface, so its triangles are inside. Tuned as above, with 16 cells around a vessel.
constexpr float kInscribed = 0.995F;

CrossSection cross_section(const glm::vec3& middle, const glm::vec3& direction, float radius, std::size_t segment) {
    const bool along_x = std::abs(direction.x) >= 0.6F * glm::length(direction);
    const glm::vec3 aside = along_x ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0);
    const glm::vec3 side = glm::normalize(glm::cross(direction, aside)),
                    up = glm::normalize(glm::cross(direction, side));
    CrossSection section{};
    for (int i = 0; i < 3; ++i) section.middle[i] = middle[i], section.side[i] = side[i], section.up[i] = up[i];
    section.radius = radius;
    section.least = kLeast, section.most = kMost;
    section.segment = static_cast<std::uint32_t>(segment);
    return section;
}

void fit_to_field(FittedCones& cones) {
    const auto& segments = cones.segments;
    const auto& on_line = cones.on_line;
    std::vector<FieldSegment> placed(segments.size() + 1, kNoSegment);
    for (std::size_t i = 0; i < segments.size(); ++i) placed[i] = cones.field_segment(segments[i], glm::mat4(1.0F));
    Field field{};
    field.segments = placed.data();
    field.first = cones.neighbours.first.data();
    field.neighbours = cones.neighbours.segments.data();
    field.root_width = std::sqrt(cones.neighbours_width);
    std::vector<CrossSection> sections;
    std::vector<std::uint32_t> points; // positions of the sections
    for (std::size_t s = 0; s < segments.size(); ++s) {
        const std::uint32_t first = segments[s].point, last = first + 1;
        const auto add = [&](std::uint32_t point, std::uint32_t from, std::uint32_t to) {
            const glm::vec3 direction = glm::vec3(on_line[to]) - glm::vec3(on_line[from]);
            if (!(glm::length(direction) > 0.0F)) return;
            const float radius = 0.5F * cones.thinned.details[point].diameter_mm;
            sections.push_back(cross_section(glm::vec3(on_line[point]), direction, radius, s));
            points.push_back(point);
        };
        // Each point with the segment that starts there; the last point of a branch with the segment that ends there.
        add(first, s > 0 && segments[s - 1].point + 1 == first ? first - 1 : first, last);
        if (s + 1 == segments.size() || segments[s + 1].point != last) add(last, first, last);
    }
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, sections.size(), 256), [&](const auto& range) {
        HWY_DYNAMIC_DISPATCH(fit_circles)(field, sections.data() + range.begin(), range.size());
    });
    for (std::size_t i = 0; i < sections.size(); ++i)
        cones.fitted[points[i]] = {sections[i].middle[0], sections[i].middle[1], sections[i].middle[2],
                                   sections[i].radius};
}

} // namespace

void fit_balls(FittedCones& cones) {
    using Segment = FittedCones::Segment;
    const auto& on_line = cones.on_line;
    const auto radius = [&](std::size_t point) { return 0.5F * cones.thinned.details[point].diameter_mm; };
    cones.fitted = on_line;
    for (std::size_t i = 0; i < cones.fitted.size(); ++i) cones.fitted[i].w = radius(i);
    if (cones.neighbours_width > 0.0F) fit_to_field(cones);
    // A ball of the vessel's radius would reach beyond a free end.
    const Tip tip = tip_of(cones.width, cones.beyond_ends);
    const auto end_at = [&](std::uint32_t end, std::uint32_t inward) {
        const glm::vec3 axis = glm::vec3(on_line[inward]) - glm::vec3(on_line[end]);
        const float whole = glm::length(axis);
        const float share = whole > 0.0F ? std::min(0.45F, tip.before * radius(end) / whole) : 0.0F;
        cones.fitted[end] = glm::vec4(glm::vec3(on_line[end]) + share * axis, tip.radius * radius(end));
    };
    for (const Segment& segment : cones.segments) {
        if (segment.previous == Segment::kFree) end_at(segment.point, segment.point + 1);
        if (segment.next == Segment::kFree) end_at(segment.point + 1, segment.point);
    }
    if (cones.width > 0.0F)
        for (glm::vec4& ball : cones.fitted) ball.w *= kInscribed;
}

} // namespace ramus::render::caster
#endif
