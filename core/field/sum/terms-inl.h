// The contribution of each segment to the plain sum of one kernel at one point, with its gradient. Vectorised over the
// segments. Included once per instruction set.
#if defined(RAMUS_FIELD_TERMS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef RAMUS_FIELD_TERMS_INL_H
#undef RAMUS_FIELD_TERMS_INL_H
#else
#define RAMUS_FIELD_TERMS_INL_H
#endif

#include "core/field/kernel.h"
#include "core/field/simd/segment_foot-inl.h"

#include <cstddef>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace ramus::field::HWY_NAMESPACE {

// Computes the values and gradients of `terms`. A term does not depend on the other segments.
template <class Profile> void find_terms(const Kernel& kernel, SegmentTerms& terms) {
    using T = Narrow;
    using One = Pack<1, T>;
    const T d;
    const PackTag<1, T> one_vector;
    const Profile profile(kernel);
    const One scale = set(one_vector, profile.scale), inverse_scale = set(one_vector, 1.0F / profile.scale);
    const auto load = [&](SegmentTerms::Numbers numbers, std::size_t n) {
        return One{{hn::LoadU(d, terms.row(numbers) + n)}};
    };
    for (std::size_t n = 0; n < terms.count; n += hn::Lanes(d)) {
        const Segments<1, T> s{load(SegmentTerms::kUx, n),     load(SegmentTerms::kUy, n),
                               load(SegmentTerms::kUz, n),     load(SegmentTerms::kLength, n),
                               load(SegmentTerms::kRadius, n), load(SegmentTerms::kSlope, n),
                               load(SegmentTerms::kBeyond, n)};
        const Foot<1, T> foot = find_foot<Ends::kSome>(s, scale, load(SegmentTerms::kX, n), load(SegmentTerms::kY, n),
                                                       load(SegmentTerms::kZ, n));
        const KernelGradient<1, T> g =
            profile.template gradient<Ends::kSome>(s, foot, growth_of(s, foot, inverse_scale));
        const auto store = [&](SegmentTerms::Numbers numbers, hn::Vec<T> v) {
            hn::StoreU(v, d, terms.row(numbers) + n);
        };
        store(SegmentTerms::kValue, g.value.v[0]);
        store(SegmentTerms::kGradientX, hn::MulAdd(g.radial.v[0], foot.qx.v[0], hn::Mul(g.axial.v[0], s.ux.v[0])));
        store(SegmentTerms::kGradientY, hn::MulAdd(g.radial.v[0], foot.qy.v[0], hn::Mul(g.axial.v[0], s.uy.v[0])));
        store(SegmentTerms::kGradientZ, hn::MulAdd(g.radial.v[0], foot.qz.v[0], hn::Mul(g.axial.v[0], s.uz.v[0])));
    }
}

} // namespace ramus::field::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
