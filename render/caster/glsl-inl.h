// Implements the GLSL that shaders/look uses for vectors of pixels: the counterpart of look/lanes.glsl. Functions have
// GLSL's names and meanings; comments note lower precision. Included once per instruction set.
#if defined(RAMUS_CASTER_GLSL_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef RAMUS_CASTER_GLSL_INL_H
#undef RAMUS_CASTER_GLSL_INL_H
#else
#define RAMUS_CASTER_GLSL_INL_H
#endif

#include "render/caster/cast_types.h"

#include <cstdint>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace ramus::render::caster::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using D = hn::CappedTag<float, 16>; // a block has 16 pixels
using DU = hn::RebindToUnsigned<D>;
using DI = hn::RebindToSigned<D>;
using V = hn::Vec<D>;
using VU = hn::Vec<DU>;
using VI = hn::Vec<DI>;
using M = hn::Mask<D>;
constexpr int kN = int(hn::MaxLanes(D()));

HWY_INLINE V set(float x) { return hn::Set(D(), x); }
HWY_INLINE V mix(V a, V b, V t) { return hn::MulAdd(t, hn::Sub(b, a), a); }
// 1 / sqrt(x), to single precision for x > 0.
HWY_INLINE V inverse_root(V x) {
    const V guess = hn::ApproximateReciprocalSqrt(x);
    return hn::Mul(guess, hn::NegMulAdd(hn::Mul(hn::Mul(set(0.5F), x), guess), guess, set(1.5F)));
}
// sqrt(x) for x > 0, and 1 / x. With one step of Newton's method both take a third of the time of the processor's own.
HWY_INLINE V root_of(V x) { return hn::Mul(x, inverse_root(x)); }
HWY_INLINE V inverse_of(V x) {
    const V guess = hn::ApproximateReciprocal(x);
    return hn::Mul(guess, hn::NegMulAdd(x, guess, set(2.0F)));
}
HWY_INLINE VU rounded(V x) { return hn::BitCast(DU(), hn::NearestInt(x)); }
HWY_INLINE M mask(hn::Mask<DU> m) { return hn::RebindMask(D(), m); }
HWY_INLINE M any_of(VU flags, std::uint32_t bits) {
    return mask(hn::Ne(hn::And(flags, hn::Set(DU(), bits)), hn::Zero(DU())));
}

// For x > 0, with an error of 4e-6. Interpolates at the Chebyshev nodes between sqrt(1/2) and sqrt(2).
HWY_INLINE V binary_logarithm(V x) {
    const DI di;
    const VI bits = hn::BitCast(di, hn::Max(x, set(1e-30F)));
    const VI exponent = hn::ShiftRight<23>(hn::Sub(bits, hn::Set(di, 0x3f3504f3)));
    const V t = hn::Sub(hn::BitCast(D(), hn::Sub(bits, hn::ShiftLeft<23>(exponent))), set(1.0F));
    V p = hn::MulAdd(set(-0.202289264F), t, set(0.316898187F));
    p = hn::MulAdd(p, t, set(-0.366925771F));
    p = hn::MulAdd(p, t, set(0.479925573F));
    p = hn::MulAdd(p, t, set(-0.721195752F));
    p = hn::MulAdd(p, t, set(1.44270044F));
    return hn::MulAdd(p, t, hn::ConvertTo(D(), exponent));
}
// With a relative error of 4e-6, for x from -120 to 120.
HWY_INLINE V power_of_two(V x) {
    const DI di;
    x = hn::Max(x, set(-120.0F));
    const VI whole = hn::NearestInt(x);
    const V t = hn::Sub(x, hn::ConvertTo(D(), whole));
    V p = hn::MulAdd(set(0.00966636852F), t, set(0.0559219758F));
    p = hn::MulAdd(p, t, set(0.24022349F));
    p = hn::MulAdd(p, t, set(0.693121045F));
    p = hn::MulAdd(p, t, set(1.0F));
    return hn::BitCast(D(), hn::Add(hn::BitCast(di, p), hn::ShiftLeft<23>(whole)));
}

HWY_INLINE VI index_of(VI row, VI stride, VI column) { return hn::Add(hn::Mul(row, stride), column); }
// One load per lane: processors with mitigations for leaks through gathers take several times as long for a gather.
template <class Value> HWY_INLINE void gather_lanes(const Value* values, VI index, Value* to) {
    alignas(64) std::int32_t at[hn::MaxLanes(D())];
    hn::Store(index, DI(), at);
    for (std::size_t k = 0; k < hn::MaxLanes(D()); ++k) to[k] = values[at[k]];
}
HWY_INLINE V gather(const float* values, VI index) {
    alignas(64) float found[hn::MaxLanes(D())];
    gather_lanes(values, index, found);
    return hn::Load(D(), found);
}
HWY_INLINE VU gather(const std::uint32_t* values, VI index) {
    alignas(64) std::uint32_t found[hn::MaxLanes(D())];
    gather_lanes(values, index, found);
    return hn::Load(DU(), found);
}

using uint = std::uint32_t;

struct Mask {
    M m;
    friend HWY_INLINE Mask operator&&(Mask a, Mask b) { return {hn::And(a.m, b.m)}; }
    friend HWY_INLINE Mask operator||(Mask a, Mask b) { return {hn::Or(a.m, b.m)}; }
    friend HWY_INLINE Mask operator!=(Mask a, Mask b) { return {hn::Xor(a.m, b.m)}; }
    friend HWY_INLINE Mask operator!(Mask a) { return {hn::Not(a.m)}; }
};
HWY_INLINE bool any(Mask mask) { return !hn::AllFalse(D(), mask.m); }

struct Uint {
    VU v;
    friend HWY_INLINE Mask operator==(Uint a, uint b) { return {mask(hn::Eq(a.v, hn::Set(DU(), b)))}; }
    friend HWY_INLINE Mask operator!=(Uint a, uint b) { return {mask(hn::Ne(a.v, hn::Set(DU(), b)))}; }
};
HWY_INLINE Mask has(Uint bits, uint bit) { return {any_of(bits.v, bit)}; }

struct Float {
    V v;
    Float() = default;
    HWY_INLINE Float(V of) : v(of) {}
    HWY_INLINE Float(float of) : v(set(of)) {}
    friend HWY_INLINE Float operator-(Float a) { return hn::Neg(a.v); }
    friend HWY_INLINE Float operator+(Float a, Float b) { return hn::Add(a.v, b.v); }
    friend HWY_INLINE Float operator-(Float a, Float b) { return hn::Sub(a.v, b.v); }
    friend HWY_INLINE Float operator*(Float a, Float b) { return hn::Mul(a.v, b.v); }
    friend HWY_INLINE Float operator/(Float a, Float b) { return hn::Div(a.v, b.v); }
    friend HWY_INLINE Mask operator<(Float a, Float b) { return {hn::Lt(a.v, b.v)}; }
    friend HWY_INLINE Mask operator>(Float a, Float b) { return {hn::Gt(a.v, b.v)}; }
    friend HWY_INLINE Mask operator<=(Float a, Float b) { return {hn::Le(a.v, b.v)}; }
    friend HWY_INLINE Mask operator>=(Float a, Float b) { return {hn::Ge(a.v, b.v)}; }
};

HWY_INLINE Float select(Mask m, Float a, Float b) { return hn::IfThenElse(m.m, a.v, b.v); }
HWY_INLINE Float mad(Float a, Float b, Float c) { return hn::MulAdd(a.v, b.v, c.v); }
HWY_INLINE Float min(Float a, Float b) { return hn::Min(a.v, b.v); }
HWY_INLINE Float max(Float a, Float b) { return hn::Max(a.v, b.v); }
HWY_INLINE Float abs(Float a) { return hn::Abs(a.v); }
HWY_INLINE Float fract(Float a) { return hn::Sub(a.v, hn::Floor(a.v)); }
HWY_INLINE Float sqrt(Float a) { return hn::Sqrt(a.v); }
HWY_INLINE Float clamp(Float a, Float low, Float high) { return min(max(a, low), high); }
HWY_INLINE Float mix(Float a, Float b, Float t) { return mix(a.v, b.v, t.v); }
HWY_INLINE Float smoothstep(float from, float to, Float a) {
    const Float t = clamp((a - from) * (1.0F / (to - from)), 0.0F, 1.0F);
    return t * t * hn::NegMulAdd(set(2.0F), t.v, set(3.0F));
}
HWY_INLINE Float reciprocal(Float a) { return inverse_of(a.v); }
HWY_INLINE Float with_sign(Float size, Float of) { return hn::CopySign(size.v, of.v); }
HWY_INLINE Float rough_inversesqrt(Float a) { return hn::ApproximateReciprocalSqrt(a.v); } // relative error 4e-4
// Error 4e-6; pow() and log() for positive arguments only.
HWY_INLINE Float exp(Float a) { return power_of_two((a * 1.44269504F).v); }
HWY_INLINE Float log(Float a) { return Float(binary_logarithm(a.v)) * 0.69314718F; }
HWY_INLINE Float pow(Float a, Float exponent) { return power_of_two((exponent * binary_logarithm(a.v)).v); }

struct Vec2 {
    Float x, y;
    Vec2() = default;
    HWY_INLINE Vec2(Float a, Float b) : x(a), y(b) {}
    friend HWY_INLINE Vec2 operator+(Vec2 a, Vec2 b) { return {a.x + b.x, a.y + b.y}; }
};

HWY_INLINE Vec2 select(Mask m, Vec2 a, Vec2 b) { return {select(m, a.x, b.x), select(m, a.y, b.y)}; }

struct Vec3 {
    Float x, y, z;
    Vec3() = default;
    HWY_INLINE Vec3(Float a, Float b, Float c) : x(a), y(b), z(c) {}
    HWY_INLINE explicit Vec3(Float all) : x(all), y(all), z(all) {}
    HWY_INLINE explicit Vec3(const vec4& of) : x(of.x), y(of.y), z(of.z) {}
    friend HWY_INLINE Vec3 operator+(Vec3 a, Vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
    friend HWY_INLINE Vec3 operator-(Vec3 a, Vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
    friend HWY_INLINE Vec3 operator*(Vec3 a, Vec3 b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }
    friend HWY_INLINE Vec3 operator*(Float a, Vec3 b) { return {a * b.x, a * b.y, a * b.z}; }
    friend HWY_INLINE Vec3 operator*(Vec3 a, Float b) { return b * a; }
};
HWY_INLINE Vec3 select(Mask m, Vec3 a, Vec3 b) {
    return {select(m, a.x, b.x), select(m, a.y, b.y), select(m, a.z, b.z)};
}
HWY_INLINE Vec3 mad(Float a, Vec3 b, Vec3 c) { return {mad(a, b.x, c.x), mad(a, b.y, c.y), mad(a, b.z, c.z)}; }
HWY_INLINE Vec3 mix(Vec3 a, Vec3 b, Float t) { return {mix(a.x, b.x, t), mix(a.y, b.y, t), mix(a.z, b.z, t)}; }
HWY_INLINE Float dot(Vec3 a, Vec3 b) { return mad(a.z, b.z, mad(a.y, b.y, a.x * b.x)); }
HWY_INLINE Float length(Vec3 a) { return root_of(max(dot(a, a), 1e-20F).v); }
HWY_INLINE Vec3 normalize(Vec3 a) { return Float(inverse_root(max(dot(a, a), 1e-30F).v)) * a; }

struct Vec4 {
    Float x, y, z, w;
    HWY_INLINE Vec4(Float a, Float b, Float c, Float d) : x(a), y(b), z(c), w(d) {}
    HWY_INLINE Vec4(Vec3 of, Float w_of) : x(of.x), y(of.y), z(of.z), w(w_of) {}
};
HWY_INLINE Vec4 select(Mask m, Vec4 a, Vec4 b) {
    return {select(m, a.x, b.x), select(m, a.y, b.y), select(m, a.z, b.z), select(m, a.w, b.w)};
}
HWY_INLINE Vec4 mix(Vec4 a, Vec4 b, Float t) {
    return {mix(a.x, b.x, t), mix(a.y, b.y, t), mix(a.z, b.z, t), mix(a.w, b.w, t)};
}

// FloatPair: two vectors that go through the same operations interleaved. The intersection of a ray with a cone is a
// long chain of dependent operations; two interleaved chains take little more time than one.
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
    HWY_INLINE FloatPair(Float both) : a(both), b(both) {}
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
// To single precision, for positive arguments.
HWY_INLINE Float quick_sqrt(Float x) { return root_of(x.v); }
HWY_INLINE FloatPair quick_sqrt(FloatPair x) { return {quick_sqrt(x.a), quick_sqrt(x.b)}; }

// Normals in 32 bits, in the shaders' format.

#define INLINE HWY_INLINE
#include "shaders/look/octahedral.glsl"
#undef INLINE

// `n` may have any length.
HWY_INLINE VU packed_normal(Vec3 n) {
    const Vec2 p = octahedral(n);
    const auto word = [](Float x) { return rounded((x * 32767.0F).v); };
    return hn::Or(hn::And(word(p.x), hn::Set(DU(), 0xffffU)), hn::ShiftLeft<16>(word(p.y)));
}

HWY_INLINE Vec3 unpacked_normal(VU bits) {
    const VI low = hn::ShiftRight<16>(hn::BitCast(DI(), hn::ShiftLeft<16>(bits)));
    const VI high = hn::ShiftRight<16>(hn::BitCast(DI(), bits));
    const auto number = [](VI word) { return Float(hn::ConvertTo(D(), word)) * (1.0F / 32767.0F); };
    return from_octahedral({number(low), number(high)});
}

} // namespace ramus::render::caster::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
