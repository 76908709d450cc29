// Pack: several vectors that undergo the same operations, interleaved. A kernel is a long chain of dependent
// operations; two interleaved chains take about the time of one. The functions here have the same names for one vector
// and for a pack, so that a kernel is written once. Included once per instruction set.
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
using Narrow = hn::CappedTag<float, 8>; // for data that would leave half of a wide vector empty

// T is the width of the vectors: the widest of the machine, or Narrow.
template <std::size_t N, class T = D> struct Pack { hn::Vec<T> v[N]; };
template <std::size_t N, class T = D> struct PackTag {};

// A pack of the results of call(n).
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

// Applies `call` to vectors, or to the corresponding vectors of packs.
template <class Call, class... Vecs> HWY_INLINE auto on_each(const Call& call, Vecs... vectors) {
    return call(vectors...);
}
template <class Call, std::size_t N, class T, class... More>
HWY_INLINE Pack<N, T> on_each(const Call& call, const Pack<N, T>& a, const More&... more) {
    return each<N, T>([&](std::size_t s) { return call(a.v[s], more.v[s]...); });
}

template <class X> HWY_INLINE X mul(X a, X b) {
    return on_each([](auto... x) { return hn::Mul(x...); }, a, b);
}
template <class X> HWY_INLINE X add(X a, X b) {
    return on_each([](auto... x) { return hn::Add(x...); }, a, b);
}
template <class X> HWY_INLINE X sub(X a, X b) {
    return on_each([](auto... x) { return hn::Sub(x...); }, a, b);
}
template <class X> HWY_INLINE X min(X a, X b) {
    return on_each([](auto... x) { return hn::Min(x...); }, a, b);
}
template <class X> HWY_INLINE X max(X a, X b) {
    return on_each([](auto... x) { return hn::Max(x...); }, a, b);
}
template <class X> HWY_INLINE X mul_add(X a, X b, X c) { // a b + c
    return on_each([](auto... x) { return hn::MulAdd(x...); }, a, b, c);
}
template <class X> HWY_INLINE X mul_sub(X a, X b, X c) { // a b - c
    return on_each([](auto... x) { return hn::MulSub(x...); }, a, b, c);
}
template <class X> HWY_INLINE X neg_mul_add(X a, X b, X c) { // c - a b
    return on_each([](auto... x) { return hn::NegMulAdd(x...); }, a, b, c);
}
template <class X> HWY_INLINE X rough_reciprocal(X a) {
    return on_each([](auto x) { return hn::ApproximateReciprocal(x); }, a);
}
// a clamped to [-most, most].
template <class X> HWY_INLINE X limited(X a, X most) {
    return on_each(
        []<class Vec>(Vec x, Vec bound) {
#if HWY_ARCH_X86 && HWY_TARGET <= HWY_AVX3 // the lesser size, with the sign of x
            if constexpr (sizeof(Vec) == 64) return Vec{_mm512_range_ps(x.raw, bound.raw, 2)};
#endif
            return hn::Max(hn::Min(x, bound), hn::Neg(bound));
        },
        a, most);
}
// p times 2^n, where n is the integer in the lowest bits of `shifted`.
template <class X> HWY_INLINE X times_power(X p, X shifted) {
    return on_each(
        []<class Vec>(Vec x, Vec power) {
            const hn::DFromV<Vec> d;
            const hn::RebindToSigned<decltype(d)> di;
            return hn::BitCast(d, hn::Add(hn::BitCast(di, x), hn::ShiftLeft<23>(hn::BitCast(di, power))));
        },
        p, shifted);
}

} // namespace ramus::field::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
