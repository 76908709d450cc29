// FloatPair: two vectors that go through the same operations side by side. The intersection of a ray with a cone is one
// long chain in which every operation waits for the one before; two chains interleaved finish in little more than the
// time of one. The functions here read the same for one vector and for a pair of them. Included once per instruction
// set.
#if defined(RAMUS_CASTER_PAIR_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef RAMUS_CASTER_PAIR_INL_H
#undef RAMUS_CASTER_PAIR_INL_H
#else
#define RAMUS_CASTER_PAIR_INL_H
#endif

#include "render/caster/glsl-inl.h"

HWY_BEFORE_NAMESPACE();
namespace ramus::render::caster::HWY_NAMESPACE {

struct MaskPair {
    Mask a, b;
    friend HWY_INLINE MaskPair operator&&(MaskPair x, MaskPair y) { return {x.a && y.a, x.b && y.b}; }
    friend HWY_INLINE MaskPair operator||(MaskPair x, MaskPair y) { return {x.a || y.a, x.b || y.b}; }
    friend HWY_INLINE MaskPair operator!(MaskPair x) { return {!x.a, !x.b}; }
};
HWY_INLINE bool any(MaskPair m) { return any(m.a || m.b); }

struct FloatPair {
    Float a, b;
    FloatPair() = default;
    HWY_INLINE FloatPair(Float first, Float second) : a(first), b(second) {}
    HWY_INLINE FloatPair(float both) : a(both), b(both) {}
    friend HWY_INLINE FloatPair operator-(FloatPair x) { return {-x.a, -x.b}; }
    friend HWY_INLINE FloatPair operator+(FloatPair x, FloatPair y) { return {x.a + y.a, x.b + y.b}; }
    friend HWY_INLINE FloatPair operator-(FloatPair x, FloatPair y) { return {x.a - y.a, x.b - y.b}; }
    friend HWY_INLINE FloatPair operator*(FloatPair x, FloatPair y) { return {x.a * y.a, x.b * y.b}; }
    friend HWY_INLINE MaskPair operator<(FloatPair x, FloatPair y) { return {x.a < y.a, x.b < y.b}; }
    friend HWY_INLINE MaskPair operator>(FloatPair x, FloatPair y) { return {x.a > y.a, x.b > y.b}; }
    friend HWY_INLINE MaskPair operator<=(FloatPair x, FloatPair y) { return {x.a <= y.a, x.b <= y.b}; }
    friend HWY_INLINE MaskPair operator>=(FloatPair x, FloatPair y) { return {x.a >= y.a, x.b >= y.b}; }
};

HWY_INLINE FloatPair select(MaskPair m, FloatPair x, FloatPair y) {
    return {select(m.a, x.a, y.a), select(m.b, x.b, y.b)};
}
HWY_INLINE FloatPair max(FloatPair x, FloatPair y) { return {max(x.a, y.a), max(x.b, y.b)}; }
HWY_INLINE FloatPair reciprocal(FloatPair x) { return {reciprocal(x.a), reciprocal(x.b)}; }
HWY_INLINE FloatPair mad(FloatPair x, FloatPair y, FloatPair z) { return {mad(x.a, y.a, z.a), mad(x.b, y.b, z.b)}; }
// x y - z and z - x y, each in one instruction.
HWY_INLINE Float msub(Float x, Float y, Float z) { return hn::MulSub(x.v, y.v, z.v); }
HWY_INLINE Float nmad(Float x, Float y, Float z) { return hn::NegMulAdd(x.v, y.v, z.v); }
HWY_INLINE FloatPair msub(FloatPair x, FloatPair y, FloatPair z) { return {msub(x.a, y.a, z.a), msub(x.b, y.b, z.b)}; }
HWY_INLINE FloatPair nmad(FloatPair x, FloatPair y, FloatPair z) { return {nmad(x.a, y.a, z.a), nmad(x.b, y.b, z.b)}; }
// To single precision, of what is positive.
HWY_INLINE Float quick_sqrt(Float x) { return root_of(x.v); }
HWY_INLINE FloatPair quick_sqrt(FloatPair x) { return {quick_sqrt(x.a), quick_sqrt(x.b)}; }

} // namespace ramus::render::caster::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
