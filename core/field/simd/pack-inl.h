// Pack: several vectors that go through the same operations side by side. The kernel is one long chain in which every
// operation waits for the one before; two chains interleaved finish in the time of one. The functions here read the
// same for one vector and for a pack of them, so that the kernel is written once. Included once per instruction set.
#if defined(RAMUS_FIELD_PACK_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef RAMUS_FIELD_PACK_INL_H
#undef RAMUS_FIELD_PACK_INL_H
#else
#define RAMUS_FIELD_PACK_INL_H
#endif

#include <cstddef>
#include <cstdint>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace ramus::field::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using D = hn::ScalableTag<float>;
using V = hn::Vec<D>;
using M = hn::Mask<D>;
using Narrow = hn::CappedTag<float, 8>; // for what would leave half of a wide vector empty

// T says how wide the vectors are: as wide as the machine's, or narrower where there is less to do.
template <std::size_t N, class T = D> struct Pack { hn::Vec<T> v[N]; };
template <std::size_t N, class T = D> struct PackTag {};

// What `call` says for each.
template <std::size_t N, class T = D, class Call> HWY_INLINE Pack<N, T> each(const Call& call) {
    Pack<N, T> p;
    for (std::size_t s = 0; s < N; ++s) p.v[s] = call(s);
    return p;
}

// Tags to values: the same number in all lanes.
template <class Tag> HWY_INLINE hn::Vec<Tag> set(Tag d, float x) { return hn::Set(d, x); }
template <std::size_t N, class T> HWY_INLINE Pack<N, T> set(PackTag<N, T>, float x) {
    return each<N, T>([&](std::size_t) { return hn::Set(T(), x); });
}

template <class Vec> HWY_INLINE Vec mul(Vec a, Vec b) { return hn::Mul(a, b); }
template <class Vec> HWY_INLINE Vec add(Vec a, Vec b) { return hn::Add(a, b); }
template <class Vec> HWY_INLINE Vec sub(Vec a, Vec b) { return hn::Sub(a, b); }
template <class Vec> HWY_INLINE Vec min(Vec a, Vec b) { return hn::Min(a, b); }
template <class Vec> HWY_INLINE Vec max(Vec a, Vec b) { return hn::Max(a, b); }
template <class Vec> HWY_INLINE Vec mul_add(Vec a, Vec b, Vec c) { return hn::MulAdd(a, b, c); }        // a b + c
template <class Vec> HWY_INLINE Vec mul_sub(Vec a, Vec b, Vec c) { return hn::MulSub(a, b, c); }        // a b - c
template <class Vec> HWY_INLINE Vec neg_mul_add(Vec a, Vec b, Vec c) { return hn::NegMulAdd(a, b, c); } // c - a b
template <class Vec> HWY_INLINE Vec rough_reciprocal(Vec a) { return hn::ApproximateReciprocal(a); }
// a taken into -most .. most.
template <class Vec> HWY_INLINE Vec limited(Vec a, Vec most) {
#if HWY_ARCH_X86 && HWY_TARGET <= HWY_AVX3 // the lesser size, with the sign of a
    if constexpr (sizeof(Vec) == 64) return Vec{_mm512_range_ps(a.raw, most.raw, 2)};
#endif
    return hn::Max(hn::Min(a, most), hn::Neg(most));
}
// p times 2 to the whole number that `shifted` holds in its lowest bits.
template <class Vec> HWY_INLINE Vec times_power(Vec p, Vec shifted) {
    const hn::DFromV<Vec> d;
    const hn::RebindToSigned<decltype(d)> di;
    return hn::BitCast(d, hn::Add(hn::BitCast(di, p), hn::ShiftLeft<23>(hn::BitCast(di, shifted))));
}

template <std::size_t N, class T> HWY_INLINE Pack<N, T> mul(const Pack<N, T>& a, const Pack<N, T>& b) {
    return each<N, T>([&](std::size_t s) { return hn::Mul(a.v[s], b.v[s]); });
}
template <std::size_t N, class T> HWY_INLINE Pack<N, T> add(const Pack<N, T>& a, const Pack<N, T>& b) {
    return each<N, T>([&](std::size_t s) { return hn::Add(a.v[s], b.v[s]); });
}
template <std::size_t N, class T> HWY_INLINE Pack<N, T> sub(const Pack<N, T>& a, const Pack<N, T>& b) {
    return each<N, T>([&](std::size_t s) { return hn::Sub(a.v[s], b.v[s]); });
}
template <std::size_t N, class T> HWY_INLINE Pack<N, T> min(const Pack<N, T>& a, const Pack<N, T>& b) {
    return each<N, T>([&](std::size_t s) { return hn::Min(a.v[s], b.v[s]); });
}
template <std::size_t N, class T> HWY_INLINE Pack<N, T> max(const Pack<N, T>& a, const Pack<N, T>& b) {
    return each<N, T>([&](std::size_t s) { return hn::Max(a.v[s], b.v[s]); });
}
template <std::size_t N, class T>
HWY_INLINE Pack<N, T> mul_add(const Pack<N, T>& a, const Pack<N, T>& b, const Pack<N, T>& c) {
    return each<N, T>([&](std::size_t s) { return hn::MulAdd(a.v[s], b.v[s], c.v[s]); });
}
template <std::size_t N, class T>
HWY_INLINE Pack<N, T> mul_sub(const Pack<N, T>& a, const Pack<N, T>& b, const Pack<N, T>& c) {
    return each<N, T>([&](std::size_t s) { return hn::MulSub(a.v[s], b.v[s], c.v[s]); });
}
template <std::size_t N, class T>
HWY_INLINE Pack<N, T> neg_mul_add(const Pack<N, T>& a, const Pack<N, T>& b, const Pack<N, T>& c) {
    return each<N, T>([&](std::size_t s) { return hn::NegMulAdd(a.v[s], b.v[s], c.v[s]); });
}
template <std::size_t N, class T> HWY_INLINE Pack<N, T> rough_reciprocal(const Pack<N, T>& a) {
    return each<N, T>([&](std::size_t s) { return rough_reciprocal(a.v[s]); });
}
template <std::size_t N, class T> HWY_INLINE Pack<N, T> limited(const Pack<N, T>& a, const Pack<N, T>& most) {
    return each<N, T>([&](std::size_t s) { return limited(a.v[s], most.v[s]); });
}
template <std::size_t N, class T> HWY_INLINE Pack<N, T> times_power(const Pack<N, T>& p, const Pack<N, T>& shifted) {
    return each<N, T>([&](std::size_t s) { return times_power(p.v[s], shifted.v[s]); });
}
// a where low < x < high, 0 elsewhere.
template <std::size_t N, class T>
HWY_INLINE Pack<N, T> where_between(const Pack<N, T>& low, const Pack<N, T>& x, const Pack<N, T>& high,
                                    const Pack<N, T>& a) {
    return each<N, T>([&](std::size_t s) {
        return hn::IfThenElseZero(hn::And(hn::Gt(x.v[s], low.v[s]), hn::Lt(x.v[s], high.v[s])), a.v[s]);
    });
}

} // namespace ramus::field::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
