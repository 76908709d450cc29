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

inline constexpr std::size_t kPack = 2;
struct Pack {
    V v[kPack];
};
struct MaskPack {
    M m[kPack];
};
struct PackTag {};

// Tags to values: the same number in all lanes.
template <class Tag> HWY_INLINE hn::Vec<Tag> set(Tag d, float x) { return hn::Set(d, x); }
HWY_INLINE Pack set(PackTag, float x) { return {hn::Set(D(), x), hn::Set(D(), x)}; }

template <class Vec> HWY_INLINE Vec mul(Vec a, Vec b) { return hn::Mul(a, b); }
template <class Vec> HWY_INLINE Vec add(Vec a, Vec b) { return hn::Add(a, b); }
template <class Vec> HWY_INLINE Vec sub(Vec a, Vec b) { return hn::Sub(a, b); }
template <class Vec> HWY_INLINE Vec min(Vec a, Vec b) { return hn::Min(a, b); }
template <class Vec> HWY_INLINE Vec max(Vec a, Vec b) { return hn::Max(a, b); }
template <class Vec> HWY_INLINE Vec mul_add(Vec a, Vec b, Vec c) { return hn::MulAdd(a, b, c); }        // a b + c
template <class Vec> HWY_INLINE Vec mul_sub(Vec a, Vec b, Vec c) { return hn::MulSub(a, b, c); }        // a b - c
template <class Vec> HWY_INLINE Vec neg_mul_add(Vec a, Vec b, Vec c) { return hn::NegMulAdd(a, b, c); } // c - a b
template <class Vec> HWY_INLINE Vec rough_reciprocal(Vec a) { return hn::ApproximateReciprocal(a); }
// p times 2 to the whole number that `shifted` holds in its lowest bits.
template <class Vec> HWY_INLINE Vec times_power(Vec p, Vec shifted) {
    const hn::DFromV<Vec> d;
    const hn::RebindToSigned<decltype(d)> di;
    return hn::BitCast(d, hn::Add(hn::BitCast(di, p), hn::ShiftLeft<23>(hn::BitCast(di, shifted))));
}

HWY_INLINE Pack mul(Pack a, Pack b) { return {hn::Mul(a.v[0], b.v[0]), hn::Mul(a.v[1], b.v[1])}; }
HWY_INLINE Pack add(Pack a, Pack b) { return {hn::Add(a.v[0], b.v[0]), hn::Add(a.v[1], b.v[1])}; }
HWY_INLINE Pack sub(Pack a, Pack b) { return {hn::Sub(a.v[0], b.v[0]), hn::Sub(a.v[1], b.v[1])}; }
HWY_INLINE Pack min(Pack a, Pack b) { return {hn::Min(a.v[0], b.v[0]), hn::Min(a.v[1], b.v[1])}; }
HWY_INLINE Pack max(Pack a, Pack b) { return {hn::Max(a.v[0], b.v[0]), hn::Max(a.v[1], b.v[1])}; }
HWY_INLINE Pack mul_add(Pack a, Pack b, Pack c) {
    return {hn::MulAdd(a.v[0], b.v[0], c.v[0]), hn::MulAdd(a.v[1], b.v[1], c.v[1])};
}
HWY_INLINE Pack mul_sub(Pack a, Pack b, Pack c) {
    return {hn::MulSub(a.v[0], b.v[0], c.v[0]), hn::MulSub(a.v[1], b.v[1], c.v[1])};
}
HWY_INLINE Pack neg_mul_add(Pack a, Pack b, Pack c) {
    return {hn::NegMulAdd(a.v[0], b.v[0], c.v[0]), hn::NegMulAdd(a.v[1], b.v[1], c.v[1])};
}
HWY_INLINE Pack rough_reciprocal(Pack a) { return {rough_reciprocal(a.v[0]), rough_reciprocal(a.v[1])}; }
HWY_INLINE Pack times_power(Pack p, Pack shifted) {
    return {times_power(p.v[0], shifted.v[0]), times_power(p.v[1], shifted.v[1])};
}
// a where low < x < high, 0 elsewhere.
HWY_INLINE Pack where_between(Pack low, Pack x, Pack high, Pack a) {
    return {hn::IfThenElseZero(hn::And(hn::Gt(x.v[0], low.v[0]), hn::Lt(x.v[0], high.v[0])), a.v[0]),
            hn::IfThenElseZero(hn::And(hn::Gt(x.v[1], low.v[1]), hn::Lt(x.v[1], high.v[1])), a.v[1])};
}

} // namespace ramus::field::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
