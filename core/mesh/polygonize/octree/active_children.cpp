#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/mesh/polygonize/octree/active_children.cpp"
// clang-format off: foreach_target compiles this file once per instruction set and must come first.
#include <hwy/foreach_target.h>
// clang-format on
#include "core/mesh/polygonize/octree/sizing.h"

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace ramus::mesh::bricks::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

void active_children(std::span<const SizingPiece> all, std::span<const std::uint32_t> pieces,
                     const field::ChildCubes& cubes, std::span<std::uint8_t> active) {
    const hn::CappedTag<float, field::kChildren> d;
    using V = hn::Vec<decltype(d)>;
    const std::size_t lanes = hn::Lanes(d);
    const field::ChildCentres centres(cubes);
    // The factor prevents rounding from dividing a brick whose cells have exactly the required size.
    const float cell = 0.25F * cubes.side * 0.9999F;
    constexpr float kSqrt3Half = 0.8660254F;
    const float ball = kSqrt3Half * cubes.side;
    for (std::size_t m = 0; m < pieces.size(); ++m) active[m] = 0;
    for (std::size_t first = 0; first < field::kChildren; first += lanes) {
        const V cx = hn::Load(d, centres.x.data() + first);
        const V cy = hn::Load(d, centres.y.data() + first);
        const V cz = hn::Load(d, centres.z.data() + first);
        for (std::size_t m = 0; m < pieces.size(); ++m) {
            const SizingPiece& piece = all[pieces[m]];
            if (piece.cell_mm >= cell) continue;
            const V ux = hn::Set(d, piece.direction.x);
            const V uy = hn::Set(d, piece.direction.y);
            const V uz = hn::Set(d, piece.direction.z);
            const V px = hn::Sub(cx, hn::Set(d, piece.start.x));
            const V py = hn::Sub(cy, hn::Set(d, piece.start.y));
            const V pz = hn::Sub(cz, hn::Set(d, piece.start.z));
            const V t = hn::Min(hn::Max(hn::MulAdd(pz, uz, hn::MulAdd(py, uy, hn::Mul(px, ux))), hn::Zero(d)),
                                hn::Set(d, piece.length));
            const V gx = hn::NegMulAdd(t, ux, px);
            const V gy = hn::NegMulAdd(t, uy, py);
            const V gz = hn::NegMulAdd(t, uz, pz);
            const float near = piece.reach_mm + ball + (cell - piece.cell_mm) * (1.0F / Sizing::kSlope);
            const V gap2 = hn::MulAdd(gz, gz, hn::MulAdd(gy, gy, hn::Mul(gx, gx)));
            HWY_ALIGN std::uint8_t bits[8] = {};
            hn::StoreMaskBits(d, hn::Lt(gap2, hn::Set(d, near * near)), bits);
            active[m] = static_cast<std::uint8_t>(active[m] | (bits[0] & ((1U << lanes) - 1)) << first);
        }
    }
}

} // namespace ramus::mesh::bricks::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace ramus::mesh::bricks {

HWY_EXPORT(active_children);

void active_children(std::span<const SizingPiece> all, std::span<const std::uint32_t> pieces,
                     const field::ChildCubes& cubes, std::span<std::uint8_t> active) {
    HWY_DYNAMIC_DISPATCH(active_children)(all, pieces, cubes, active);
}

} // namespace ramus::mesh::bricks
#endif
