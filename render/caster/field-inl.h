// Evaluates the field of the convolution surface around a cone, two segments at a time. It answers two questions: which
// layer a surface point belongs to where glass meets opaque vessels (that of the branch with the largest contribution,
// as in the mesh), and the surface's normal. Cones alone have creases where vessels fork and bend; the field has none.
// Included once per instruction set.
#if defined(RAMUS_CASTER_FIELD_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef RAMUS_CASTER_FIELD_INL_H
#undef RAMUS_CASTER_FIELD_INL_H
#else
#define RAMUS_CASTER_FIELD_INL_H
#endif

#include "core/field/kernels/gaussian-inl.h"
#include "render/caster/glsl-inl.h"

HWY_BEFORE_NAMESPACE();
namespace ramus::render::caster::HWY_NAMESPACE {

namespace kernel = ramus::field::HWY_NAMESPACE;

// Calls call(i, pair, foot) for the pairs list[i], list[i + 1] with i from `first` up to but excluding `last`. `foot`:
// the foot of the point `at` on both segments.
template <class Call>
HWY_INLINE void for_neighbours(const Field& field, const std::uint32_t* list, std::uint32_t first, std::uint32_t last,
                               Vec3 at, const Call& call) {
    const auto root_width = kernel::set(kernel::PackTag<2>(), field.root_width);
    for (std::uint32_t i = first; i < last; i += 2) {
        const FieldSegment &a = field.segments[list[i]], &b = field.segments[list[i + 1]];
        const auto both = [](float x, float y) { return kernel::Pack<2>{set(x), set(y)}; };
        const kernel::Segments<2> pair{both(a.direction[0], b.direction[0]),
                                       both(a.direction[1], b.direction[1]),
                                       both(a.direction[2], b.direction[2]),
                                       both(a.length, b.length),
                                       both(a.radius, b.radius),
                                       both(a.slope, b.slope),
                                       both(a.beyond, b.beyond)};
        const auto from = [&](Float x, int c) { return kernel::Pack<2>{(x - a.from[c]).v, (x - b.from[c]).v}; };
        call(i, pair,
             kernel::find_foot<kernel::Ends::kSome>(pair, root_width, from(at.x, 0), from(at.y, 1), from(at.z, 2)));
    }
}

// Sum of the field's contributions per branch, at one point per lane.
struct BranchSums {
    static constexpr int kMax = 8; // branches; further ones are ignored, since more rarely meet
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

// Of the points `at` where rays hit `cone` (only lanes in `which` count): those that belong to a branch of the cone's
// layer.
HWY_INLINE Mask own_layer_leads(const Field& field, std::uint32_t cone, Mask which, Vec3 at) {
    BranchSums others, own;
    for_neighbours(field, field.other_layer, field.first_other[cone], field.first_other[cone + 1], at,
                   [&](std::uint32_t i, const kernel::Segments<2>& pair, const kernel::Foot<2>& foot) {
                       const kernel::Pack<2> value = kernel::Gaussian::value<kernel::Ends::kSome>(pair, foot);
                       for (std::uint32_t s = 0; s < 2; ++s)
                           others.add(field.branch[field.other_layer[i + s]], value.v[s]);
                   });
    const Float other = others.largest();
    // The leading branch contributes a good share of the isovalue on the surface.
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

// Gradient of the field around the cone, per mm, with depth as +z; in the lanes `here`.
HWY_INLINE Vec3 local_gradient(const Field& field, std::uint32_t cone, Mask here, Vec3 at) {
    const auto inverse_root = kernel::set(kernel::PackTag<2>(), 1.0F / field.root_width);
    Vec3 sum(0.0F);
    const auto add = [&](std::uint32_t, const kernel::Segments<2>& pair, const kernel::Foot<2>& foot) {
        const Float closest = hn::Min(foot.rho.v[0], foot.rho.v[1]);
        if (!any(here && closest < kernel::kFadeEndScaled)) return;
        const kernel::KernelGradient<2> g =
            kernel::Gaussian::gradient<kernel::Ends::kSome>(pair, foot, kernel::growth_of(pair, foot, inverse_root));
        for (int s = 0; s < 2; ++s) {
            const Float radial = g.radial.v[s], axial = g.axial.v[s];
            sum = mad(radial, Vec3(foot.qx.v[s], foot.qy.v[s], foot.qz.v[s]),
                      mad(axial, Vec3(pair.ux.v[s], pair.uy.v[s], pair.uz.v[s]), sum));
        }
    };
    for_neighbours(field, field.neighbours, field.first[cone], field.first[cone + 1], at, add);
    return sum;
}

// Summary of the points where one pixel's samples hit a vessel.
struct SeenPoints {
    Vec3 at;      // point on the ray through the pixel's middle, at the samples' mean depth
    Vec3 sight;   // unit direction of that ray
    Float spread; // mean square distance of the samples from the middle, mm^2, in x and in y alike
};

// Distance in mm from `seen.at` towards the eye, to where the ray meets the planes that touch the vessel at the
// samples; sample_normal() says why normals are taken there. At a distance v around its axis, the vessel has fallen v^2
// / 2r behind its tangent plane. The mean depth lies that far behind the vessel, and the planes lie as far in front of
// it. For samples around a ray that meets the vessel at an angle of cosine f, the mean square of v is spread *
// sin^2(ray, axis) / f^2, and a distance along the normal is 1 / f times as long along the ray.
HWY_INLINE Float way_to_planes(const FieldSegment& vessel, const SeenPoints& seen, Vec3 normal) {
    constexpr float kLeastFacing = 0.25F; // tuned: at flatter angles the vessel ends before it falls so far
    const Vec3 axis(vessel.direction[0], vessel.direction[1], vessel.direction[2]);
    const Float along = dot(axis, seen.sight), across = nmad(along, along, 1.0F);
    const Float facing = nmad(normal.x, seen.sight.x, msub(normal.z, seen.sight.z, normal.y * seen.sight.y));
    const Float inverse = reciprocal(max(facing, kLeastFacing));
    const float radius = vessel.radius + 0.5F * vessel.slope * vessel.length;
    return min(seen.spread * across * (1.0F / radius) * inverse * inverse * inverse, 0.5F * radius);
}

// Normals where rays hit `cones`, for the lanes in `which`. Other lanes, and lanes where the field's gradient is
// unreliable, keep `normal`, which may have any length.
HWY_INLINE Vec3 field_normals(const Field& field, Mask which, VU cones, const SeenPoints& seen, Vec3 normal) {
    const D d;
    const DU du;
    alignas(64) std::uint32_t index[hn::MaxLanes(D())];
    hn::Store(cones, du, index);
    const Vec3 before = normalize(normal);
    for (Mask left = which; any(left);) {
        const std::uint32_t cone = index[hn::FindFirstTrue(d, left.m)];
        // In the few pixels of a vector, the neighbours of one cone also serve the cones next to it.
        Mask here = {hn::FirstN(d, 0)};
        for (std::uint32_t i = field.first[cone]; i < field.first[cone + 1]; ++i)
            here = here || Uint{cones} == field.neighbours[i];
        here = here && left;
        left = left && !here;
        const Float nearer = way_to_planes(field.segments[cone], seen, before);
        const Vec3 inward = local_gradient(field, cone, here, seen.at - nearer * seen.sight);
        Vec3 outward = {-inward.x, -inward.y, inward.z}; // depth grows away from the eye, normals have z towards it
        const Float squared = dot(outward, outward);
        outward = Float(inverse_root(max(squared, 1e-20F).v)) * outward;
        normal = select(here && squared > 1e-12F && dot(outward, before) > 0.0F, outward, normal);
    }
    return normal;
}

} // namespace ramus::render::caster::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
