// Bounds of the plain sum of one kernel over the eight children of a cube, and the segments that reach each child.
// Vectorised over the children, so that all lanes are used for short lists of segments, too. Included once per
// instruction set.
#if defined(RAMUS_FIELD_BOUNDS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef RAMUS_FIELD_BOUNDS_INL_H
#undef RAMUS_FIELD_BOUNDS_INL_H
#else
#define RAMUS_FIELD_BOUNDS_INL_H
#endif

#include "core/field/kernel.h"
#include "core/field/simd/segment_foot-inl.h"

#include <algorithm>
#include <cmath>
#include <hwy/highway.h>
#include <span>

HWY_BEFORE_NAMESPACE();
namespace ramus::field::HWY_NAMESPACE {

// One lane per child, in one or two vectors.
using D8 = hn::CappedTag<float, kChildren>;
using V8 = hn::Vec<D8>;
using M8 = hn::Mask<D8>;

// A box is large if its squared half edge exceeds this many squared supports of a segment.
constexpr float kLarge = 4.0F;
// In half edges of a large box: for a longer segment its axis-aligned box is too coarse a test, since the box of a
// diagonal segment contains many boxes that the segment does not come near.
constexpr float kLong = 4.0F;

// The middles of boxes relative to a segment's start, mm.
struct Offsets {
    V8 x, y, z;
};

// The squared distance of boxes of half edge h from the segment's axis-aligned box: a lower bound of the squared
// distance from the segment that is tight for large boxes.
HWY_INLINE V8 distance2_along_axes(D8 d, const CullingSegment& s, const Offsets& p, V8 h) {
    const V8 half_length = hn::Mul(hn::Set(d, 0.5F), hn::Set(d, s.length));
    const auto apart = [&](V8 offset, float direction) {
        const V8 u = hn::Set(d, direction);
        const V8 from_middle = hn::Abs(hn::NegMulAdd(half_length, u, offset));
        return hn::Max(hn::Sub(from_middle, hn::MulAdd(half_length, hn::Abs(u), h)), hn::Zero(d));
    };
    const V8 gx = apart(p.x, s.ux);
    const V8 gy = apart(p.y, s.uy);
    const V8 gz = apart(p.z, s.uz);
    return hn::MulAdd(gz, gz, hn::MulAdd(gy, gy, hn::Mul(gx, gx)));
}

// Boxes relative to a segment. look_at_boxes() computes what is needed to test whether the segment reaches them;
// finish() computes the rest.
struct Sight {
    BoxView<D8> box;       // finish() fills in coarse, fine and farthest
    V8 distance2;          // a lower bound of the squared distance that is tight for small boxes
    V8 thinnest, thickest; // least and largest radius at the foot of any point of a box
    V8 extent_off, off2; // extent of the box away from the axis times the distance of its middle; that distance squared

    // `corner2`: squared distance of a box's corner from its middle.
    HWY_INLINE void finish(D8 d, V8 bound_scale, V8 corner2) {
        box.coarse = hn::Div(bound_scale, thickest);
        box.fine = hn::Div(bound_scale, thinnest);
        // |q + offset|^2 = |q|^2 + 2 q . offset + |offset|^2, with the maximum of each part.
        box.farthest = hn::Sqrt(hn::Add(hn::MulAdd(hn::Set(d, 2.0F), extent_off, off2), corner2));
    }
};
HWY_INLINE Sight look_at_boxes(D8 d, const CullingSegment& s, const Offsets& p, V8 h) {
    const V8 zero = hn::Zero(d);
    const V8 ux = hn::Set(d, s.ux);
    const V8 uy = hn::Set(d, s.uy);
    const V8 uz = hn::Set(d, s.uz);
    const V8 length = hn::Set(d, s.length);
    Sight seen;
    BoxView<D8>& box = seen.box;
    box.t = hn::MulAdd(p.z, uz, hn::MulAdd(p.y, uy, hn::Mul(p.x, ux)));
    box.along = hn::Mul(h, hn::Set(d, std::abs(s.ux) + std::abs(s.uy) + std::abs(s.uz)));
    const V8 qx = hn::NegMulAdd(box.t, ux, p.x);
    const V8 qy = hn::NegMulAdd(box.t, uy, p.y);
    const V8 qz = hn::NegMulAdd(box.t, uz, p.z);
    seen.off2 = hn::MulAdd(qz, qz, hn::MulAdd(qy, qy, hn::Mul(qx, qx)));
    const V8 off = hn::Sqrt(seen.off2);
    // 1e-20 avoids a division by 0 if the middle is on the axis.
    seen.extent_off = hn::Mul(h, hn::Add(hn::Abs(qx), hn::Add(hn::Abs(qy), hn::Abs(qz))));
    box.nearest = hn::Max(hn::Sub(off, hn::Div(seen.extent_off, hn::Max(off, hn::Set(d, 1e-20F)))), zero);
    box.beyond = hn::Sub(box.t, hn::Max(hn::Min(box.t, length), zero));
    const V8 gap = hn::Max(hn::Sub(hn::Abs(box.beyond), box.along), zero);
    const RadiusLanes<V8> radii{length, hn::Set(d, s.radius), hn::Set(d, s.slope), hn::Set(d, s.beyond)};
    const V8 r1 = radius_along(d, radii, hn::Sub(box.t, box.along)).radius;
    const V8 r2 = radius_along(d, radii, hn::Add(box.t, box.along)).radius;
    seen.thinnest = hn::Min(r1, r2);
    seen.thickest = hn::Max(r1, r2);
    // Combines the distance from the line and the distance beyond the ends.
    seen.distance2 = hn::MulAdd(gap, gap, hn::Mul(box.nearest, box.nearest));
    return seen;
}

// Sets the bits of the boxes that a segment reaches, beginning with the bit `first`. Returns whether there are any.
HWY_INLINE bool note(D8 d, M8 reaches, std::size_t first, std::uint8_t& reaching) {
    HWY_ALIGN std::uint8_t bits[8] = {};
    hn::StoreMaskBits(d, reaches, bits);
    const unsigned reached = bits[0] & ((1U << hn::Lanes(d)) - 1);
    reaching = static_cast<std::uint8_t>(reaching | reached << first);
    return reached != 0;
}

// FieldModel's bound_children() (field.h).
template <class Profile>
ChildBounds bound_children(const Kernel& kernel, const CullingSegment* segments, std::span<const std::uint32_t> list,
                           const ChildCubes& cubes, std::span<std::uint8_t> reaching) {
    const D8 d;
    const Profile profile(kernel);
    // Boxes are enlarged by the rounding of positions to single precision.
    const glm::vec3 middle = cubes.middle;
    const float farthest = std::max({std::abs(middle.x), std::abs(middle.y), std::abs(middle.z)}) + cubes.side;
    const float half_extent = 0.5F * cubes.side * 1.0001F + 6e-7F * farthest;
    const V8 h = hn::Set(d, half_extent);
    const V8 corner2 = hn::Set(d, 3.0F * half_extent * half_extent);
    const V8 isovalue = hn::Set(d, static_cast<float>(kernel.isovalue));
    const V8 bound_scale = hn::Set(d, profile.bound_scale);
    // The margin covers the rounding of single precision far from the origin.
    const auto support2_per_radius2 = static_cast<float>(1.001 * kernel.support_radii * kernel.support_radii);
    const ChildCentres centres(cubes);
    ChildBounds bounds;
    for (std::size_t m = 0; m < list.size(); ++m) reaching[m] = 0;
    for (std::size_t first = 0; first < kChildren; first += hn::Lanes(d)) {
        const V8 cx = hn::Load(d, centres.x.data() + first);
        const V8 cy = hn::Load(d, centres.y.data() + first);
        const V8 cz = hn::Load(d, centres.z.data() + first);
        V8 lower = hn::Zero(d);
        V8 upper = hn::Zero(d);
        for (std::size_t m = 0; m < list.size(); ++m) {
            const CullingSegment& s = segments[list[m]];
            const Offsets p{hn::Sub(cx, hn::Set(d, s.ax)), hn::Sub(cy, hn::Set(d, s.ay)),
                            hn::Sub(cz, hn::Set(d, s.az))};
            const float support2 = s.thickest * s.thickest * support2_per_radius2;
            M8 reaches = hn::Lt(distance2_along_axes(d, s, p, h), hn::Set(d, support2));
            if (half_extent * half_extent > kLarge * support2) {
                // No box lies within the support, so the lower bound stays 0. A box this large is split anyway, so the
                // upper bound only has to reach the isovalue.
                if (s.length > kLong * half_extent)
                    reaches = hn::And(reaches, hn::Lt(look_at_boxes(d, s, p, h).distance2, hn::Set(d, support2)));
                upper = hn::IfThenElse(reaches, isovalue, upper);
                note(d, reaches, first, reaching[m]);
                continue;
            }
            Sight seen = look_at_boxes(d, s, p, h);
            const V8 local_support2 = hn::Mul(hn::Mul(seen.thickest, seen.thickest), hn::Set(d, support2_per_radius2));
            reaches = hn::And(reaches, hn::Lt(seen.distance2, local_support2));
            if (!note(d, reaches, first, reaching[m])) continue;
            seen.finish(d, bound_scale, corner2);
            // Once the upper bound has reached the isovalue, its exact value does not matter.
            if (!hn::AllFalse(d, hn::And(reaches, hn::Lt(upper, isovalue))))
                upper = hn::Add(upper, hn::IfThenElseZero(reaches, profile.upper_bound(d, s, seen.box)));
            lower = hn::Add(lower, hn::IfThenElseZero(reaches, profile.lower_bound(d, s, seen.box, reaches)));
        }
        hn::StoreU(lower, d, bounds.lower.data() + first);
        hn::StoreU(upper, d, bounds.upper.data() + first);
    }
    return bounds;
}

} // namespace ramus::field::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
