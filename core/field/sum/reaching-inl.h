// Finds the segments of a brick that reach a box of points, in SIMD, one lane per segment. Included once per
// instruction set.
#if defined(RAMUS_FIELD_REACHING_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef RAMUS_FIELD_REACHING_INL_H
#undef RAMUS_FIELD_REACHING_INL_H
#else
#define RAMUS_FIELD_REACHING_INL_H
#endif

#include "core/field/simd/segment_foot-inl.h"
#include "core/field/sum/local_segments.h"

HWY_BEFORE_NAMESPACE();
namespace ramus::field::HWY_NAMESPACE {

// Coordinates along one axis relative to a segment's start, rounded to single precision.
template <std::size_t N>
HWY_INLINE void subtract(const std::array<double, N>& axis, double start, float* HWY_RESTRICT out) {
    const hn::CappedTag<double, 8> dd;
    const hn::Rebind<float, decltype(dd)> df;
    static_assert(N % 8 == 0);
    for (std::size_t n = 0; n < N; n += hn::Lanes(dd))
        hn::StoreU(hn::DemoteTo(df, hn::Sub(hn::LoadU(dd, axis.data() + n), hn::Set(dd, start))), df, out + n);
}

// Fills in the arrays of LocalSegments, for its list and axes.
inline void gather_segments(LocalSegments& local) {
    local.has_excess = false;
    for (std::size_t m = 0; m < local.count; ++m) {
        const FieldSegment& s = local.segments[local.list[m]];
        float* table = local.tables.data() + m * LocalSegments::kTableStride;
        subtract(local.axes.x, s.ax, table);
        subtract(local.axes.y, s.ay, table + 8);
        subtract(local.axes.z, s.az, table + 16);
        local.x[m] = -table[0], local.y[m] = -table[8], local.z[m] = -table[16];
        local.ux[m] = s.ux, local.uy[m] = s.uy, local.uz[m] = s.uz;
        local.length[m] = s.length, local.radius[m] = s.radius, local.slope[m] = s.slope, local.beyond[m] = s.beyond;
        local.branch[m] = s.branch;
        local.excess[m] = s.excess, local.excess_slope[m] = s.excess_slope;
        local.has_excess |= s.excess != 0.0F || s.excess_slope != 0.0F;
    }
}

// A box relative to the brick's corner, mm.
struct Box {
    glm::vec3 middle, half;
};

// The vector of segments that begins at the m-th.
template <class T, class V = hn::Vec<T>> struct SegmentLanes {
    V x, y, z, ux, uy, uz, length, radius, slope, beyond;

    HWY_INLINE SegmentLanes(T d, const LocalSegments& local, std::size_t m)
        : x(hn::LoadU(d, local.x.data() + m)), y(hn::LoadU(d, local.y.data() + m)), z(hn::LoadU(d, local.z.data() + m)),
          ux(hn::LoadU(d, local.ux.data() + m)), uy(hn::LoadU(d, local.uy.data() + m)),
          uz(hn::LoadU(d, local.uz.data() + m)), length(hn::LoadU(d, local.length.data() + m)),
          radius(hn::LoadU(d, local.radius.data() + m)), slope(hn::LoadU(d, local.slope.data() + m)),
          beyond(hn::LoadU(d, local.beyond.data() + m)) {}
};

// A box relative to each segment of a vector.
template <class T, class V = hn::Vec<T>> struct BoxInSight {
    V distance2;     // lower bound of the squared distance
    V t_low, t_high; // range of axial coordinates of the box
    V thickest;      // largest radius in this range
};

template <class T, class V = hn::Vec<T>>
HWY_INLINE BoxInSight<T> look_at(T d, const Box& box, const SegmentLanes<T>& s) {
    const V zero = hn::Zero(d);
    const V hx = hn::Set(d, box.half.x);
    const V hy = hn::Set(d, box.half.y);
    const V hz = hn::Set(d, box.half.z);
    const V px = hn::Sub(hn::Set(d, box.middle.x), s.x);
    const V py = hn::Sub(hn::Set(d, box.middle.y), s.y);
    const V pz = hn::Sub(hn::Set(d, box.middle.z), s.z);
    const V t = hn::MulAdd(pz, s.uz, hn::MulAdd(py, s.uy, hn::Mul(px, s.ux)));
    const V along = hn::MulAdd(hz, hn::Abs(s.uz), hn::MulAdd(hy, hn::Abs(s.uy), hn::Mul(hx, hn::Abs(s.ux))));
    const V qx = hn::NegMulAdd(t, s.ux, px);
    const V qy = hn::NegMulAdd(t, s.uy, py);
    const V qz = hn::NegMulAdd(t, s.uz, pz);
    const V off2 = hn::MulAdd(qz, qz, hn::MulAdd(qy, qy, hn::Mul(qx, qx)));
    // Toward the axis the box extends by extent_off / off.
    const V extent_off = hn::MulAdd(hz, hn::Abs(qz), hn::MulAdd(hy, hn::Abs(qy), hn::Mul(hx, hn::Abs(qx))));
    const V inverse_off = hn::ApproximateReciprocalSqrt(hn::Max(off2, hn::Set(d, 1e-30F)));
    const V nearest = hn::Max(hn::Mul(hn::NegMulAdd(hn::Set(d, 1.001F), extent_off, off2), inverse_off), zero);
    BoxInSight<T> seen;
    seen.t_low = hn::Sub(t, along);
    seen.t_high = hn::Add(t, along);
    const V gap = hn::Max(hn::Max(hn::Neg(seen.t_high), hn::Sub(seen.t_low, s.length)), zero);
    seen.thickest = hn::Max(radius_along(d, s, seen.t_low).radius, radius_along(d, s, seen.t_high).radius);
    // A second lower bound: the distance of the box from the segment's axis-aligned box.
    const V half_length = hn::Mul(hn::Set(d, 0.5F), s.length);
    const auto apart = [&](V p, V u, V h) {
        const V from_middle = hn::Abs(hn::NegMulAdd(half_length, u, p));
        return hn::Max(hn::Sub(from_middle, hn::MulAdd(half_length, hn::Abs(u), h)), zero);
    };
    const V gx = apart(px, s.ux, hx);
    const V gy = apart(py, s.uy, hy);
    const V gz = apart(pz, s.uz, hz);
    const V apart2 = hn::MulAdd(gz, gz, hn::MulAdd(gy, gy, hn::Mul(gx, gx)));
    seen.distance2 = hn::Max(apart2, hn::MulAdd(gap, gap, hn::Mul(nearest, nearest)));
    return seen;
}

// Tests the vector of segments that begins at the m-th, for find_reaching().
template <std::size_t N, class T, class V = hn::Vec<T>, class M = hn::Mask<T>>
HWY_INLINE void judge_segments(T d, std::size_t m, LocalSegments& local, const Box (&boxes)[N],
                               std::size_t (&found)[N]) {
    const hn::RebindToSigned<T> di;
    // The factors cover rounding.
    const double support = local.kernel->support_radii;
    const V support2 = hn::Set(d, static_cast<float>(1.003 * support * support));
    const V ends_radii = hn::Set(d, static_cast<float>(1.001 * local.kernel->ends_radii));
    const SegmentLanes<T> segments(d, local, m);
    const auto code = hn::ShiftLeft<1>(hn::Add(hn::Iota(di, 0), hn::Set(di, static_cast<std::int32_t>(m))));
    const M valid = hn::FirstN(d, local.count - m);
    HWY_UNROLL(4)
    for (std::size_t n = 0; n < N; ++n) {
        const BoxInSight<T> seen = look_at(d, boxes[n], segments);
        const M reaches =
            hn::And(hn::Lt(seen.distance2, hn::Mul(hn::Mul(seen.thickest, seen.thickest), support2)), valid);
        const V far = hn::Mul(seen.thickest, ends_radii);
        const M ends = hn::Lt(hn::Min(seen.t_low, hn::Sub(segments.length, seen.t_high)), far);
        // A mask is -1 where it is set.
        const auto marked = hn::Sub(code, hn::VecFromMask(di, hn::RebindMask(di, ends)));
        // Stores a whole vector; the next store overwrites the invalid lanes. A compressing store is microcode on some
        // processors, and slower than a kernel.
        const auto which = hn::RebindMask(di, reaches);
        hn::StoreU(hn::Compress(marked, which), di, local.reaching_part(n) + found[n]);
        found[n] += hn::CountTrue(di, which);
    }
}

// For each box, writes the segments whose support reaches the box to its part of local.reaching, in ascending order,
// each as 2 m + Ends, and their number to `found`. All other segments are exactly 0 everywhere in the box. The boxes of
// a call are interleaved, since each is a long chain of dependent operations.
template <std::size_t N>
HWY_INLINE void find_reaching(LocalSegments& local, const Box (&boxes)[N], std::size_t (&found)[N]) {
    const D wide;
    const Narrow narrow;
    for (std::size_t n = 0; n < N; ++n) found[n] = 0;
    std::size_t m = 0;
    for (; m + hn::Lanes(narrow) < local.count; m += hn::Lanes(wide)) judge_segments(wide, m, local, boxes, found);
    if (m < local.count) judge_segments(narrow, m, local, boxes, found);
}

// Lists all segments, as if they all reached the box with their ends.
HWY_INLINE std::size_t list_all(const LocalSegments& local, std::int32_t* reaching) {
    std::size_t found = 0;
    for (; found < local.count; ++found) reaching[found] = static_cast<std::int32_t>(2 * found + 1);
    return found;
}

// The segments of a pack, as indices into the local arrays.
template <std::size_t N> struct PackIndices {
    std::size_t m[N];
    bool near_ends;
};
template <std::size_t N> HWY_INLINE PackIndices<N> pack_indices(const std::int32_t* reaching) {
    PackIndices<N> indices;
    std::int32_t any = 0;
    for (std::size_t s = 0; s < N; ++s) {
        const std::int32_t code = reaching[s];
        indices.m[s] = static_cast<std::size_t>(code >> 1);
        any |= code;
    }
    indices.near_ends = (any & 1) != 0;
    return indices;
}
template <class T = D, std::size_t N>
HWY_INLINE Pack<N, T> broadcast(const std::vector<float>& of, const PackIndices<N>& at) {
    return each<N, T>([&](std::size_t s) { return hn::Set(T(), of[at.m[s]]); });
}
template <class T = D, std::size_t N>
HWY_INLINE Segments<N, T> broadcast(const LocalSegments& local, const PackIndices<N>& at) {
    return {broadcast<T>(local.ux, at),     broadcast<T>(local.uy, at),     broadcast<T>(local.uz, at),
            broadcast<T>(local.length, at), broadcast<T>(local.radius, at), broadcast<T>(local.slope, at),
            broadcast<T>(local.beyond, at)};
}

} // namespace ramus::field::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
