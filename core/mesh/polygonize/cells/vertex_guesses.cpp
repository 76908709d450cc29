#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/mesh/polygonize/cells/vertex_guesses.cpp"
// clang-format off: foreach_target compiles this file once per instruction set and must come first.
#include <hwy/foreach_target.h>
// clang-format on
#include "core/mesh/polygonize/cells/vertex_guesses.h"

#include <array>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace ramus::mesh::bricks::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
using D = hn::ScalableTag<float>;
using DI = hn::RebindToSigned<D>;
using V = hn::Vec<D>;
using VI = hn::Vec<DI>;
using M = hn::Mask<D>;

// Sums over the crossed edges of a cell.
struct Sums {
    std::array<V, 3> at;
    V count;
};

// Adds the crossing of the edge along `Axis` at `Side` (u + 2 v on the other two axes), if there is one.
template <int Axis, int Side>
HWY_INLINE void add_crossing(D d, const std::array<V, 8>& depth, const std::array<M, 8>& outside, Sums& sums) {
    constexpr int kU = (Axis + 1) % 3;
    constexpr int kV = (Axis + 2) % 3;
    constexpr std::size_t kFrom = static_cast<std::size_t>((Side & 1) << kU | (Side >> 1) << kV);
    constexpr std::size_t kTo = kFrom | std::size_t{1} << Axis;
    const V one = hn::Set(d, 1.0F);
    const M crossed = hn::Xor(outside[kFrom], outside[kTo]);
    const V along = hn::Mul(depth[kFrom], hn::ApproximateReciprocal(hn::Sub(depth[kFrom], depth[kTo])));
    const V t = hn::Max(hn::Min(along, hn::Set(d, 1.0F - kCrossingMargin)), hn::Set(d, kCrossingMargin));
    const V unit = hn::IfThenElseZero(crossed, one);
    sums.count = hn::Add(sums.count, unit);
    sums.at[Axis] = hn::Add(sums.at[Axis], hn::IfThenElseZero(crossed, t));
    if constexpr ((Side & 1) != 0) sums.at[kU] = hn::Add(sums.at[kU], unit);
    if constexpr ((Side & 2) != 0) sums.at[kV] = hn::Add(sums.at[kV], unit);
}

template <int Axis>
HWY_INLINE void add_crossings(D d, const std::array<V, 8>& depth, const std::array<M, 8>& outside, Sums& sums) {
    add_crossing<Axis, 0>(d, depth, outside, sums);
    add_crossing<Axis, 1>(d, depth, outside, sums);
    add_crossing<Axis, 2>(d, depth, outside, sums);
    add_crossing<Axis, 3>(d, depth, outside, sums);
}

// The depths at a brick's grid points, for lookup by index.
#if HWY_ARCH_X86 && HWY_TARGET <= HWY_AVX3 // in registers: gathering takes these processors several times as long
struct Depths {
    __m512 part[8];
    HWY_INLINE explicit Depths(const float* depths) {
        for (std::size_t n = 0; n < 8; ++n) part[n] = _mm512_load_ps(depths + 16 * n);
    }
    [[nodiscard]] HWY_INLINE V at(VI point) const {
        const auto quarter = [&](std::size_t n) { // of which the lowest five bits choose
            return _mm512_permutex2var_ps(part[2 * n], point.raw, part[2 * n + 1]);
        };
        const __mmask16 odd = _mm512_test_epi32_mask(point.raw, _mm512_set1_epi32(32));
        const __mmask16 upper = _mm512_test_epi32_mask(point.raw, _mm512_set1_epi32(64));
        const __m512 low = _mm512_mask_mov_ps(quarter(0), odd, quarter(1));
        const __m512 high = _mm512_mask_mov_ps(quarter(2), odd, quarter(3));
        return V{_mm512_mask_mov_ps(low, upper, high)};
    }
};
#else
struct Depths {
    const float* depths;
    HWY_INLINE explicit Depths(const float* from) : depths(from) {}
    [[nodiscard]] HWY_INLINE V at(VI point) const { return hn::GatherIndex(D(), depths, point); }
};
#endif

void add_vertex_guesses(const field::GridValues& depths, std::span<const std::uint8_t> corners, float cell_mm,
                        std::size_t first, field::Projection& points) {
    const D d;
    const DI di;
    const std::size_t lanes = hn::Lanes(d);
    const V zero = hn::Zero(d);
    const Depths all(depths.data());
    constexpr std::array<int, 8> kCornerOffset{0, 1, 5, 6, 25, 26, 30, 31};
    const hn::Rebind<std::uint8_t, DI> d8;
    const V cell = hn::Set(d, cell_mm);
    const V half = hn::Set(d, 0.5F);
    const V reach = hn::Set(d, kVertexReach * cell_mm);
    for (std::size_t n = 0; n < corners.size(); n += lanes) {
        const VI corner = hn::PromoteTo(di, hn::LoadU(d8, corners.data() + n));
        std::array<V, 8> depth_at;
        std::array<M, 8> outside;
        for (std::size_t c = 0; c < 8; ++c) {
            depth_at[c] = all.at(hn::Add(corner, hn::Set(di, kCornerOffset[c])));
            outside[c] = hn::Lt(depth_at[c], zero);
        }
        Sums sums{{zero, zero, zero}, zero};
        add_crossings<0>(d, depth_at, outside, sums);
        add_crossings<1>(d, depth_at, outside, sums);
        add_crossings<2>(d, depth_at, outside, sums);
        // Decomposes x + 5 y + 25 z; exact for indices of a brick.
        const VI z = hn::ShiftRight<10>(hn::Mul(corner, hn::Set(di, 41)));
        const VI in_layer = hn::Sub(corner, hn::Mul(z, hn::Set(di, 25)));
        const VI y = hn::ShiftRight<6>(hn::Mul(in_layer, hn::Set(di, 13)));
        const VI x = hn::Sub(in_layer, hn::Mul(y, hn::Set(di, 5)));
        const V share = hn::Div(hn::Set(d, 1.0F), hn::Max(sums.count, hn::Set(d, 1.0F)));
        const auto put = [&](VI low, V sum, float* guess, float* centre) {
            const V at = hn::ConvertTo(d, low);
            hn::StoreU(hn::Mul(hn::MulAdd(sum, share, at), cell), d, guess + first + n);
            hn::StoreU(hn::Mul(hn::Add(at, half), cell), d, centre + first + n);
        };
        put(x, sums.at[0], points.x.data(), points.cx.data());
        put(y, sums.at[1], points.y.data(), points.cy.data());
        put(z, sums.at[2], points.z.data(), points.cz.data());
        hn::StoreU(reach, d, points.reach.data() + first + n);
    }
}

} // namespace ramus::mesh::bricks::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace ramus::mesh::bricks {

HWY_EXPORT(add_vertex_guesses);

void add_vertex_guesses(const field::GridValues& depths, std::span<const std::uint8_t> corners, float cell_mm,
                        field::Projection& points) {
    const std::size_t first = points.extend(corners.size());
    HWY_DYNAMIC_DISPATCH(add_vertex_guesses)(depths, corners, cell_mm, first, points);
}

} // namespace ramus::mesh::bricks
#endif
