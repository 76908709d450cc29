#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/field/culling.cpp"
// clang-format off: foreach_target compiles this file once per instruction set and must come first.
#include <hwy/foreach_target.h>
// clang-format on
#include "core/field/culling.h"
#include "core/field/kernel-inl.h"

#include <algorithm>
#include <cmath>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace ramus::field::HWY_NAMESPACE {

// One lane per child, in one or two vectors.
using D8 = hn::CappedTag<float, kChildren>;
using V8 = hn::Vec<D8>;

// Square of half a box's edge, in supports of a segment, from which on the box counts as large.
constexpr float kLarge = 4.0F;

// Boxes seen from one segment. How far a box extends along the axis and away from it is what bounds are made of: along
// a direction n a cube reaches h (|nx| + |ny| + |nz|) to either side of its middle, h being half its edge.
struct BoxView {
    V8 t, along;          // axial coordinate of the middle, and how far the box extends from it, mm
    V8 nearest, farthest; // least and greatest distance from the line, mm
    V8 beyond;            // axial distance of the middle beyond the ends, signed, mm
    V8 coarse, fine;      // sqrt(w) / r at the thickest and the thinnest place that the box sees, 1/mm
};

HWY_INLINE void add_upper(D8 d, const CullingSegment& s, const BoxView& box, hn::Mask<D8> reaches, V8& upper) {
    const V8 zero = hn::Zero(d);
    const V8 length = hn::Set(d, s.length);
    const V8 middle = hn::Mul(hn::Set(d, 0.5F), length);
    // The end filter is highest nearest to the segment's middle, lowest farthest from it; erf grows with its argument,
    // so each term takes the radius that bounds it.
    const V8 q_min = hn::Mul(box.nearest, box.coarse);
    const V8 t_best = hn::Max(hn::Min(middle, hn::Add(box.t, box.along)), hn::Sub(box.t, box.along));
    const auto term = [&](V8 v) {
        return half_error_function(d, hn::Mul(v, hn::IfThenElse(hn::Ge(v, zero), box.fine, box.coarse)));
    };
    const V8 filter = hn::Add(term(t_best), term(hn::Sub(length, t_best)));
    const V8 gauss = exp_negative(d, hn::Min(hn::Mul(q_min, q_min), hn::Set(d, 40.0F)));
    upper = hn::Add(upper, hn::IfThenElseZero(reaches, hn::Mul(gauss, filter)));
}

HWY_INLINE void add_lower(D8 d, const CullingSegment& s, const BoxView& box, hn::Mask<D8> reaches, V8& lower) {
    const V8 zero = hn::Zero(d);
    const V8 q_max = hn::Mul(box.farthest, box.fine);
    const V8 e_max = hn::Mul(hn::Add(hn::Abs(box.beyond), box.along), box.fine);
    const V8 rho_max = hn::MulAdd(e_max, e_max, hn::Mul(q_max, q_max));
    if (hn::AllFalse(d, hn::And(reaches, hn::Lt(rho_max, hn::Set(d, static_cast<float>(kFadeEnd)))))) return;
    const V8 length = hn::Set(d, s.length);
    const V8 middle = hn::Mul(hn::Set(d, 0.5F), length);
    const V8 t_worst = hn::IfThenElse(hn::Gt(box.t, middle), hn::Add(box.t, box.along), hn::Sub(box.t, box.along));
    const auto term = [&](V8 v) {
        return half_error_function(d, hn::Mul(v, hn::IfThenElse(hn::Ge(v, zero), box.coarse, box.fine)));
    };
    const V8 filter = hn::Max(zero, hn::Add(term(t_worst), term(hn::Sub(length, t_worst))));
    const V8 gauss = hn::Mul(exp_negative(d, hn::Min(hn::Mul(q_max, q_max), hn::Set(d, 40.0F))), fade(d, rho_max));
    lower = hn::Add(lower, hn::IfThenElseZero(reaches, hn::Mul(gauss, filter)));
}

// Notes which of the boxes from the first on a segment reaches, and returns whether there are any.
HWY_INLINE bool note(D8 d, hn::Mask<D8> reaches, std::size_t first, std::uint8_t& reaching) {
    HWY_ALIGN std::uint8_t bits[8] = {};
    hn::StoreMaskBits(d, reaches, bits);
    const unsigned reached = bits[0] & ((1U << hn::Lanes(d)) - 1);
    reaching = static_cast<std::uint8_t>(reaching | reached << first);
    return reached != 0;
}

void CullChildren(const Kernel& kernel, const CullingSegment* segments, const std::uint32_t* list, std::size_t count,
                  glm::vec3 middle, float child_side, float half_extent, std::uint8_t* HWY_RESTRICT reaching,
                  ChildBounds& bounds) {
    const D8 d;
    const std::size_t lanes = hn::Lanes(d);
    const V8 sqrt_w = hn::Set(d, static_cast<float>(kernel.sqrt_w));
    const V8 h = hn::Set(d, half_extent);
    const V8 corner2 = hn::Set(d, 3.0F * half_extent * half_extent); // squared distance of a corner from the middle
    const V8 zero = hn::Zero(d);
    const V8 isovalue = hn::Set(d, static_cast<float>(kernel.isovalue));
    // The margin covers the rounding of single precision far from the origin.
    const auto support2_per_radius2 = static_cast<float>(kFadeEnd * 1.001 / (kernel.sqrt_w * kernel.sqrt_w));
    const ChildCentres centres(middle, child_side);
    for (std::size_t m = 0; m < count; ++m) reaching[m] = 0;
    for (std::size_t first = 0; first < kChildren; first += lanes) {
        const V8 cx = hn::Load(d, centres.x.data() + first);
        const V8 cy = hn::Load(d, centres.y.data() + first);
        const V8 cz = hn::Load(d, centres.z.data() + first);
        V8 lower = zero;
        V8 upper = zero;
        for (std::size_t m = 0; m < count; ++m) {
            const CullingSegment& s = segments[list[m]];
            const V8 px = hn::Sub(cx, hn::Set(d, s.ax));
            const V8 py = hn::Sub(cy, hn::Set(d, s.ay));
            const V8 pz = hn::Sub(cz, hn::Set(d, s.az));
            const V8 ux = hn::Set(d, s.ux);
            const V8 uy = hn::Set(d, s.uy);
            const V8 uz = hn::Set(d, s.uz);
            const V8 length = hn::Set(d, s.length);
            // A first bound of the distance, along the axes of the boxes. Close where they are large.
            const V8 half_length = hn::Mul(hn::Set(d, 0.5F), length);
            const auto apart = [&](V8 p, V8 u) {
                const V8 from_middle = hn::Abs(hn::NegMulAdd(half_length, u, p));
                return hn::Max(hn::Sub(from_middle, hn::MulAdd(half_length, hn::Abs(u), h)), zero);
            };
            const V8 gx = apart(px, ux);
            const V8 gy = apart(py, uy);
            const V8 gz = apart(pz, uz);
            const float thickest = std::max(s.radius, s.radius + s.slope * s.length);
            const float support2 = thickest * thickest * support2_per_radius2;
            auto reaches = hn::Lt(hn::MulAdd(gz, gz, hn::MulAdd(gy, gy, hn::Mul(gx, gx))), hn::Set(d, support2));
            if (half_extent * half_extent > kLarge * support2) {
                // No box lies within the support, so there is nothing to gain for the lower bound; and boxes so large
                // are split in any case.
                upper = hn::IfThenElse(reaches, isovalue, upper);
                note(d, reaches, first, reaching[m]);
                continue;
            }
            BoxView box;
            box.t = hn::MulAdd(pz, uz, hn::MulAdd(py, uy, hn::Mul(px, ux)));
            box.along = hn::Mul(h, hn::Set(d, std::abs(s.ux) + std::abs(s.uy) + std::abs(s.uz)));
            const V8 qx = hn::NegMulAdd(box.t, ux, px);
            const V8 qy = hn::NegMulAdd(box.t, uy, py);
            const V8 qz = hn::NegMulAdd(box.t, uz, pz);
            const V8 off2 = hn::MulAdd(qz, qz, hn::MulAdd(qy, qy, hn::Mul(qx, qx)));
            const V8 off = hn::Sqrt(off2);
            // The box's extent away from the axis, times the distance from it: no division where the two coincide.
            const V8 extent_off = hn::Mul(h, hn::Add(hn::Abs(qx), hn::Add(hn::Abs(qy), hn::Abs(qz))));
            box.nearest = hn::Max(hn::Sub(off, hn::Div(extent_off, hn::Max(off, hn::Set(d, 1e-20F)))), zero);
            box.beyond = hn::Sub(box.t, hn::Max(hn::Min(box.t, length), zero));
            const V8 gap = hn::Max(hn::Sub(hn::Abs(box.beyond), box.along), zero);
            // Radii that any point of the box may see.
            const V8 radius = hn::Set(d, s.radius);
            const V8 slope = hn::Set(d, s.slope);
            const V8 r1 = hn::MulAdd(slope, hn::Max(hn::Min(hn::Sub(box.t, box.along), length), zero), radius);
            const V8 r2 = hn::MulAdd(slope, hn::Max(hn::Min(hn::Add(box.t, box.along), length), zero), radius);
            const V8 r_max = hn::Max(r1, r2);
            // The second bound: away from the line and beyond its ends. Close where boxes are small.
            const V8 distance2 = hn::MulAdd(gap, gap, hn::Mul(box.nearest, box.nearest));
            reaches =
                hn::And(reaches, hn::Lt(distance2, hn::Mul(hn::Mul(r_max, r_max), hn::Set(d, support2_per_radius2))));
            if (!note(d, reaches, first, reaching[m])) continue;
            box.coarse = hn::Div(sqrt_w, r_max);
            box.fine = hn::Div(sqrt_w, hn::Min(r1, r2));
            // |q + offset|^2 = |q|^2 + 2 q . offset + |offset|^2, each part at its greatest.
            box.farthest = hn::Sqrt(hn::Add(hn::MulAdd(hn::Set(d, 2.0F), extent_off, off2), corner2));
            // Where it is certain that the field may reach the isovalue, by how much does not matter.
            if (!hn::AllFalse(d, hn::And(reaches, hn::Lt(upper, isovalue)))) add_upper(d, s, box, reaches, upper);
            add_lower(d, s, box, reaches, lower);
        }
        hn::Store(lower, d, bounds.lower.data() + first);
        hn::Store(upper, d, bounds.upper.data() + first);
    }
}

} // namespace ramus::field::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace ramus::field {

HWY_EXPORT(CullChildren);

CullingSegments::CullingSegments(const ConvolutionField& field) : origin(0.5 * (field.lower() + field.upper())) {
    segments.reserve(field.segments().size());
    for (const FieldSegment& s : field.segments())
        segments.push_back({static_cast<float>(s.ax - origin.x), static_cast<float>(s.ay - origin.y),
                            static_cast<float>(s.az - origin.z), s.ux, s.uy, s.uz, s.length, s.radius, s.slope});
}

ChildBounds cull_children(const ConvolutionField& field, const CullingSegments& culling,
                          std::span<const std::uint32_t> list, glm::vec3 middle, float child_side,
                          std::span<std::uint8_t> reaching) {
    ChildBounds bounds;
    // Positions in single precision relative to the origin: widen the boxes by what they may be off.
    const float farthest = std::max({std::abs(middle.x), std::abs(middle.y), std::abs(middle.z)}) + child_side;
    const float half_extent = 0.5F * child_side * 1.0001F + 6e-7F * farthest;
    HWY_DYNAMIC_DISPATCH(CullChildren)
    (field.kernel(), culling.segments.data(), list.data(), list.size(), middle, child_side, half_extent,
     reaching.data(), bounds);
    return bounds;
}

} // namespace ramus::field
#endif
