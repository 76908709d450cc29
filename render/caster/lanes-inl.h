// Vectors of floats and what the shaders' shared files hold, for the caster's stages. Included once per instruction
// set.
#if defined(RAMUS_CASTER_LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef RAMUS_CASTER_LANES_INL_H
#undef RAMUS_CASTER_LANES_INL_H
#else
#define RAMUS_CASTER_LANES_INL_H
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
// sqrt(x) for x > 0, and 1 / x: with one step of Newton's method both take a third of the processor's own.
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

// To 4e-6, of x > 0; interpolated at the Chebyshev nodes between the roots of 1/2 and 2.
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
// To 4e-6 of its value, for x from -120 to 120.
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
// One load a lane: processors that guard their gathers against leaks take several times as long for those.
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

} // namespace ramus::render::caster::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
