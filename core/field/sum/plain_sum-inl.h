// plain_sum(): builds the functions of PlainSum (kernel.h) from the profile of a kernel, for one instruction set.
// Included once per instruction set, by the kernel's source file.
//
// A profile is a struct that is constructed from a Kernel and has these members, static or not. Gaussian in
// kernels/gaussian-inl.h is an example; kernels/compact_line-inl.h is a profile for compact line integrals.
//     scale, bound_scale           factors of lengths over the radius, in Foot and in BoxView
//     value<Near>(segments, foot)  the kernel, for a pack of segments (Near: whether their ends matter)
//     gradient<Near>(segments, foot, growth)
//     upper_bound(d, segment, box), lower_bound(d, segment, box, reaches)
//     newton(d, sum)               the Newton step onto the surface
//     kShortStep                   if the first step is shorter, there is no second step
//     rough_distance(d, value)     a function of the field that grows outward, nearly linear in the distance
//     along_edge(value)            a scalar function of the field that is nearly linear along an edge
// Values, gradients and bounds must be exactly 0 outside of the support.
#if defined(RAMUS_FIELD_PLAIN_SUM_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef RAMUS_FIELD_PLAIN_SUM_INL_H
#undef RAMUS_FIELD_PLAIN_SUM_INL_H
#else
#define RAMUS_FIELD_PLAIN_SUM_INL_H
#endif

#include "core/field/sum/bounds-inl.h"
#include "core/field/sum/projection-inl.h"
#include "core/field/sum/sampling-inl.h"
#include "core/field/sum/terms-inl.h"

#include <memory>

HWY_BEFORE_NAMESPACE();
namespace ramus::field::HWY_NAMESPACE {

// The BrickField of the plain sum.
template <class Profile> class SumInBrick final : public BrickField {
public:
    SumInBrick(const Kernel& kernel, const FieldSegment* segments, Choice choice) : profile_(kernel), choice_(choice) {
        local_.kernel = &kernel;
        local_.segments = segments;
    }

    void enter(SegmentIndices list, const GridAxes& axes) override {
        local_.enter(list, axes);
        gather_segments(local_);
    }
    std::uint64_t sample_groups(unsigned groups, GridGroups& samples) override {
        return HWY_NAMESPACE::sample_groups(profile_, local_, groups, samples, choice_);
    }
    std::uint64_t sample_lattice(const LatticeAxes& lattice, std::span<const LatticePoint> points,
                                 std::span<float> values) override {
        return HWY_NAMESPACE::sample_lattice(profile_, local_, lattice, points, values);
    }
    std::uint64_t project(Projection& guesses, const SurfacePoints& to) override {
        if (guesses.size() == 0 || local_.count == 0) return 0;
        guesses.pad();
        return project_onto_surface(profile_, local_, guesses, to);
    }
    void find_depths(const GridValues& values, GridValues& depths) const override {
        HWY_NAMESPACE::find_depths(profile_, static_cast<float>(local_.kernel->isovalue), values, depths);
    }
    [[nodiscard]] float crossing(float from, float to) const override {
        const float start = profile_.along_edge(from);
        const float surface = profile_.along_edge(static_cast<float>(local_.kernel->isovalue));
        return (surface - start) / (profile_.along_edge(to) - start);
    }

private:
    Profile profile_;
    LocalSegments local_;
    Choice choice_;
};

template <class Profile> const PlainSum* plain_sum() {
    static const PlainSum sum{
        hwy::TargetName(HWY_TARGET),
        [](const Kernel& kernel, const FieldSegment* segments, Choice choice) -> std::unique_ptr<BrickField> {
            return std::make_unique<SumInBrick<Profile>>(kernel, segments, choice);
        },
        &bound_children<Profile>, &find_terms<Profile>};
    return &sum;
}

} // namespace ramus::field::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
