// Which of a brick's segments reach a box of points, in SIMD, one lane per segment. Included once per instruction set.
#if defined(RAMUS_FIELD_REACHING_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef RAMUS_FIELD_REACHING_INL_H
#undef RAMUS_FIELD_REACHING_INL_H
#else
#define RAMUS_FIELD_REACHING_INL_H
#endif

#include "core/field/kernel-inl.h"
#include "core/field/local_segments.h"

HWY_BEFORE_NAMESPACE();
namespace ramus::field::HWY_NAMESPACE {

// Coordinates along one axis, seen from a segment's start.
template <std::size_t N>
HWY_INLINE void subtract(const std::array<double, N>& axis, double start, float* HWY_RESTRICT out) {
    const hn::CappedTag<double, 8> dd;
    const hn::Rebind<float, decltype(dd)> df;
    static_assert(N % 8 == 0);
    for (std::size_t n = 0; n < N; n += hn::Lanes(dd))
        hn::StoreU(hn::DemoteTo(df, hn::Sub(hn::LoadU(dd, axis.data() + n), hn::Set(dd, start))), df, out + n);
}

// A box relative to the brick's corner, mm.
struct Box {
    glm::vec3 middle, half;
};

// A vector of segments from the m-th on, for find_reaching().
template <std::size_t N, class T, class V = hn::Vec<T>, class M = hn::Mask<T>>
HWY_INLINE void judge_segments(T d, std::size_t m, const LocalSegments& local, float root, const Box (&boxes)[N],
                               std::size_t (&found)[N]) {
    const hn::RebindToSigned<T> di;
    const V zero = hn::Zero(d);
    const V sqrt_w = hn::Set(d, root);
    const V ux = hn::LoadU(d, local.ux.data() + m);
    const V uy = hn::LoadU(d, local.uy.data() + m);
    const V uz = hn::LoadU(d, local.uz.data() + m);
    const V length = hn::LoadU(d, local.length.data() + m);
    const V slope = hn::LoadU(d, local.slope.data() + m);
    const V radius = hn::LoadU(d, local.radius.data() + m);
    const V half_length = hn::Mul(hn::Set(d, 0.5F), length);
    const auto code = hn::ShiftLeft<1>(hn::Add(hn::Iota(di, 0), hn::Set(di, static_cast<std::int32_t>(m))));
    const M valid = hn::FirstN(d, local.count - m);
    HWY_UNROLL(4)
    for (std::size_t n = 0; n < N; ++n) {
        const V hx = hn::Set(d, boxes[n].half.x);
        const V hy = hn::Set(d, boxes[n].half.y);
        const V hz = hn::Set(d, boxes[n].half.z);
        const V px = hn::Sub(hn::Set(d, boxes[n].middle.x), hn::LoadU(d, local.x.data() + m));
        const V py = hn::Sub(hn::Set(d, boxes[n].middle.y), hn::LoadU(d, local.y.data() + m));
        const V pz = hn::Sub(hn::Set(d, boxes[n].middle.z), hn::LoadU(d, local.z.data() + m));
        const V t = hn::MulAdd(pz, uz, hn::MulAdd(py, uy, hn::Mul(px, ux)));
        const V along = hn::MulAdd(hz, hn::Abs(uz), hn::MulAdd(hy, hn::Abs(uy), hn::Mul(hx, hn::Abs(ux))));
        const V qx = hn::NegMulAdd(t, ux, px);
        const V qy = hn::NegMulAdd(t, uy, py);
        const V qz = hn::NegMulAdd(t, uz, pz);
        const V off2 = hn::MulAdd(qz, qz, hn::MulAdd(qy, qy, hn::Mul(qx, qx)));
        // Along the way to the axis the box extends by extent_off / off.
        const V extent_off = hn::MulAdd(hz, hn::Abs(qz), hn::MulAdd(hy, hn::Abs(qy), hn::Mul(hx, hn::Abs(qx))));
        const V inverse_off = hn::ApproximateReciprocalSqrt(hn::Max(off2, hn::Set(d, 1e-30F)));
        const V nearest = hn::Max(hn::Mul(hn::NegMulAdd(hn::Set(d, 1.001F), extent_off, off2), inverse_off), zero);
        const V t_low = hn::Sub(t, along);
        const V t_high = hn::Add(t, along);
        const V gap = hn::Max(hn::Max(hn::Neg(t_high), hn::Sub(t_low, length)), zero);
        const V r1 = hn::MulAdd(slope, hn::Max(hn::Min(t_low, length), zero), radius);
        const V r2 = hn::MulAdd(slope, hn::Max(hn::Min(t_high, length), zero), radius);
        const V thickest = hn::Max(r1, r2);
        // A little more than the fade's end and the error function's covers the rounding.
        const V reach = hn::Mul(thickest, thickest);
        // Along the box's own axes as well.
        const auto apart = [&](V p, V u, V h) {
            const V from_middle = hn::Abs(hn::NegMulAdd(half_length, u, p));
            return hn::Max(hn::Sub(from_middle, hn::MulAdd(half_length, hn::Abs(u), h)), zero);
        };
        const V gx = apart(px, ux, hx);
        const V gy = apart(py, uy, hy);
        const V gz = apart(pz, uz, hz);
        const V apart2 = hn::MulAdd(gz, gz, hn::MulAdd(gy, gy, hn::Mul(gx, gx)));
        const V distance2 =
            hn::Mul(hn::Max(apart2, hn::MulAdd(gap, gap, hn::Mul(nearest, nearest))), hn::Mul(sqrt_w, sqrt_w));
        const M reaches =
            hn::And(hn::Lt(distance2, hn::Mul(reach, hn::Set(d, static_cast<float>(kFadeEnd * 1.003)))), valid);
        const V far = hn::Mul(thickest, hn::Set(d, kErrorFunctionEnd * 1.001F));
        const M ends = hn::Lt(hn::Mul(hn::Min(t_low, hn::Sub(length, t_high)), sqrt_w), far);
        // A mask is -1 where it is set.
        const auto marked = hn::Sub(code, hn::VecFromMask(di, hn::RebindMask(di, ends)));
        // A whole vector, of which the next one overwrites what does not count: storing only what counts is
        // microcode on some processors, and slower than a kernel.
        const auto which = hn::RebindMask(di, reaches);
        hn::StoreU(hn::Compress(marked, which), di, local.reaching_part(n) + found[n]);
        found[n] += hn::CountTrue(di, which);
    }
}

// Writes the segments whose support reaches each of the boxes to its part of local.reaching, in order, each as 2 m +
// the ends (Ends) that points of the box may be near, and tells how many they are. The others are exactly zero
// everywhere in the box. The boxes of a call are judged side by side: each is one long chain of operations.
template <std::size_t N>
HWY_INLINE void find_reaching(const LocalSegments& local, float root, const Box (&boxes)[N], std::size_t (&found)[N]) {
    const D wide;
    const Narrow narrow;
    for (std::size_t n = 0; n < N; ++n) found[n] = 0;
    std::size_t m = 0;
    for (; m + hn::Lanes(narrow) < local.count; m += hn::Lanes(wide))
        judge_segments(wide, m, local, root, boxes, found);
    if (m < local.count) judge_segments(narrow, m, local, root, boxes, found);
}

// All segments, as if they reached the box and the box were near their ends.
HWY_INLINE std::size_t list_all(const LocalSegments& local, std::int32_t* reaching) {
    std::size_t found = 0;
    for (; found < local.count; ++found) reaching[found] = static_cast<std::int32_t>(2 * found + 1);
    return found;
}

// The segments of a pack, by their places in the local arrays.
template <std::size_t N> struct Places {
    std::size_t m[N];
    bool near_ends;
};
template <std::size_t N> HWY_INLINE Places<N> places_of(const std::int32_t* reaching) {
    Places<N> places;
    std::int32_t any = 0;
    for (std::size_t s = 0; s < N; ++s) {
        const std::int32_t code = reaching[s];
        places.m[s] = static_cast<std::size_t>(code >> 1);
        any |= code;
    }
    places.near_ends = (any & 1) != 0;
    return places;
}
template <class T = D, std::size_t N>
HWY_INLINE Pack<N, T> broadcast(const std::vector<float>& of, const Places<N>& at) {
    return each<N, T>([&](std::size_t s) { return hn::Set(T(), of[at.m[s]]); });
}
template <class T = D, std::size_t N>
HWY_INLINE Segments<N, T> broadcast(const LocalSegments& local, const Places<N>& at) {
    return {broadcast<T>(local.ux, at),     broadcast<T>(local.uy, at),     broadcast<T>(local.uz, at),
            broadcast<T>(local.length, at), broadcast<T>(local.radius, at), broadcast<T>(local.slope, at)};
}

} // namespace ramus::field::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
