#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tests/core/field/soft_kernel.cpp"
// clang-format off: foreach_target compiles this file once per instruction set and must come first.
#include <hwy/foreach_target.h>
// clang-format on
#include "core/field/sum/plain_sum-inl.h"
#include "tests/support/soft_kernel.h"

#include <cmath>

HWY_BEFORE_NAMESPACE();
namespace ramus::field::HWY_NAMESPACE {

struct Soft {
    static constexpr float kInverse = static_cast<float>(1.0 / (test::kSoftSupport * test::kSoftSupport));
    static constexpr float kShortStep = 0.001F; // of F
    float scale = 1.0F, bound_scale = 1.0F;
    float isovalue;

    explicit Soft(const Kernel& kernel) : isovalue(static_cast<float>(kernel.isovalue)) {}

    template <class Tag, class Vec> static HWY_INLINE Vec base(Tag d, Vec rho) {
        return max(neg_mul_add(rho, set(d, kInverse), set(d, 1.0F)), set(d, 0.0F));
    }
    template <class Vec> static HWY_INLINE Vec cube(Vec c) { return mul(c, mul(c, c)); }

    template <Ends Near, std::size_t N, class T>
    static HWY_INLINE Pack<N, T> value(const Segments<N, T>& /*s*/, const Foot<N, T>& f) {
        return cube(base(PackTag<N, T>(), f.rho));
    }
    template <Ends Near, std::size_t N, class T>
    static HWY_INLINE KernelGradient<N, T> gradient(const Segments<N, T>& /*s*/, const Foot<N, T>& f,
                                                    const Pack<N, T>& growth) {
        const PackTag<N, T> d;
        const Pack<N, T> c = base(d, f.rho);
        const Pack<N, T> slope = mul(mul(c, c), set(d, -6.0F * kInverse)); // twice that by rho
        const Pack<N, T> axial = neg_mul_add(f.q, growth, mul(f.e, f.scale));
        return {cube(c), mul(slope, mul(f.scale, f.scale)), mul(slope, axial)};
    }
    template <class Tag, class Vec = hn::Vec<Tag>>
    static HWY_INLINE Vec upper_bound(Tag d, const CullingSegment& /*s*/, const BoxView<Tag>& box) {
        const Vec q = hn::Mul(box.nearest, box.coarse);
        const Vec e = hn::Mul(hn::Max(hn::Sub(hn::Abs(box.beyond), box.along), hn::Zero(d)), box.coarse);
        return cube(base(d, hn::MulAdd(e, e, hn::Mul(q, q))));
    }
    template <class Tag, class Vec = hn::Vec<Tag>>
    static HWY_INLINE Vec lower_bound(Tag d, const CullingSegment& /*s*/, const BoxView<Tag>& box, hn::Mask<Tag>) {
        const Vec q = hn::Mul(box.farthest, box.fine);
        const Vec e = hn::Mul(hn::Add(hn::Abs(box.beyond), box.along), box.fine);
        return cube(base(d, hn::MulAdd(e, e, hn::Mul(q, q))));
    }
    template <class Tag, class Vec = hn::Vec<Tag>> HWY_INLINE NewtonStep<Tag> newton(Tag d, Vec sum) const {
        const Vec off = hn::Sub(hn::Set(d, isovalue), sum);
        return {off, off};
    }
    template <class Tag, class Vec = hn::Vec<Tag>> static HWY_INLINE Vec rough_distance(Tag d, Vec value) {
        return hn::Sub(hn::Set(d, 1.0F), value);
    }
    static float along_edge(float value) { return value; }
};

const PlainSum* soft_sum() { return plain_sum<Soft>(); }

} // namespace ramus::field::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace ramus {

namespace field {
HWY_EXPORT(soft_sum);
static const PlainSum* soft_sum_in_use() { return HWY_DYNAMIC_DISPATCH(soft_sum)(); }
} // namespace field

field::Kernel test::soft_kernel() {
    const double isovalue = std::pow(1.0 - 1.0 / (kSoftSupport * kSoftSupport), 3.0);
    return {1.0, isovalue, kSoftSupport, 0.0, field::soft_sum_in_use(), nullptr, {}, 0.0, {}};
}

} // namespace ramus
#endif
