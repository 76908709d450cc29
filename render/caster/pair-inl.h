// Pair: two vectors that go through the same operations side by side. Where a ray meets a cone is one long chain in
// which every operation waits for the one before; two chains interleaved finish in little more than the time of one.
// The functions here read the same for one vector and for a pair of them. Included once per instruction set.
#if defined(RAMUS_CASTER_PAIR_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef RAMUS_CASTER_PAIR_INL_H
#undef RAMUS_CASTER_PAIR_INL_H
#else
#define RAMUS_CASTER_PAIR_INL_H
#endif

#include "render/caster/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace ramus::render::caster::HWY_NAMESPACE {

struct Pair {
    V a, b;
};
struct MaskPair {
    M a, b;
};

template <class Vec> HWY_INLINE Vec Splat(float x);
template <> HWY_INLINE V Splat<V>(float x) { return hn::Set(D(), x); }
template <> HWY_INLINE Pair Splat<Pair>(float x) { return {hn::Set(D(), x), hn::Set(D(), x)}; }

using hn::Add;
using hn::And;
using hn::AndNot;
using hn::Ge;
using hn::Gt;
using hn::IfThenElse;
using hn::IfThenElseZero;
using hn::Le;
using hn::Lt;
using hn::Max;
using hn::Mul;
using hn::MulAdd;
using hn::MulSub;
using hn::Neg;
using hn::NegMulAdd;
using hn::Not;
using hn::Or;
using hn::Sub;
HWY_INLINE Pair Add(Pair x, Pair y) { return {hn::Add(x.a, y.a), hn::Add(x.b, y.b)}; }
HWY_INLINE Pair Sub(Pair x, Pair y) { return {hn::Sub(x.a, y.a), hn::Sub(x.b, y.b)}; }
HWY_INLINE Pair Mul(Pair x, Pair y) { return {hn::Mul(x.a, y.a), hn::Mul(x.b, y.b)}; }
HWY_INLINE Pair Max(Pair x, Pair y) { return {hn::Max(x.a, y.a), hn::Max(x.b, y.b)}; }
HWY_INLINE Pair Neg(Pair x) { return {hn::Neg(x.a), hn::Neg(x.b)}; }
HWY_INLINE Pair MulAdd(Pair x, Pair y, Pair z) { return {hn::MulAdd(x.a, y.a, z.a), hn::MulAdd(x.b, y.b, z.b)}; }
HWY_INLINE Pair MulSub(Pair x, Pair y, Pair z) { return {hn::MulSub(x.a, y.a, z.a), hn::MulSub(x.b, y.b, z.b)}; }
HWY_INLINE Pair NegMulAdd(Pair x, Pair y, Pair z) {
    return {hn::NegMulAdd(x.a, y.a, z.a), hn::NegMulAdd(x.b, y.b, z.b)};
}
HWY_INLINE Pair root_of(Pair x) { return {root_of(x.a), root_of(x.b)}; }
HWY_INLINE Pair inverse_of(Pair x) { return {inverse_of(x.a), inverse_of(x.b)}; }
HWY_INLINE MaskPair Gt(Pair x, Pair y) { return {hn::Gt(x.a, y.a), hn::Gt(x.b, y.b)}; }
HWY_INLINE MaskPair Lt(Pair x, Pair y) { return {hn::Lt(x.a, y.a), hn::Lt(x.b, y.b)}; }
HWY_INLINE MaskPair Ge(Pair x, Pair y) { return {hn::Ge(x.a, y.a), hn::Ge(x.b, y.b)}; }
HWY_INLINE MaskPair Le(Pair x, Pair y) { return {hn::Le(x.a, y.a), hn::Le(x.b, y.b)}; }
HWY_INLINE MaskPair And(MaskPair x, MaskPair y) { return {hn::And(x.a, y.a), hn::And(x.b, y.b)}; }
HWY_INLINE MaskPair Or(MaskPair x, MaskPair y) { return {hn::Or(x.a, y.a), hn::Or(x.b, y.b)}; }
HWY_INLINE MaskPair Not(MaskPair x) { return {hn::Not(x.a), hn::Not(x.b)}; }
HWY_INLINE MaskPair AndNot(MaskPair x, MaskPair y) { return {hn::AndNot(x.a, y.a), hn::AndNot(x.b, y.b)}; }
HWY_INLINE Pair IfThenElse(MaskPair m, Pair x, Pair y) {
    return {hn::IfThenElse(m.a, x.a, y.a), hn::IfThenElse(m.b, x.b, y.b)};
}
HWY_INLINE Pair IfThenElseZero(MaskPair m, Pair x) {
    return {hn::IfThenElseZero(m.a, x.a), hn::IfThenElseZero(m.b, x.b)};
}
HWY_INLINE bool None(M m) { return hn::AllFalse(D(), m); }
HWY_INLINE bool None(MaskPair m) { return hn::AllFalse(D(), hn::Or(m.a, m.b)); }

} // namespace ramus::render::caster::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
