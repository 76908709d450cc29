// Makes of a kernel's profile all that summing it over segments takes (KernelFunctions), for one instruction set.
// Included once per instruction set, by the kernel's source file.
//
// A profile is a struct that is made from a Kernel and has (as Gaussian in kernels/gaussian-inl.h):
//     scale, bound_scale           of lengths, times 1 / radius, in Foot and in BoxView
//     value<Near>(segments, foot)  the kernel, for a pack of segments (Near: whether their ends matter)
//     gradient<Near>(segments, foot, growth)
//     upper_bound(d, segment, box), lower_bound(d, segment, box, reaches)
//     newton(d, sum)               the step onto the surface, and kShortStep
//     rough_distance(d, value)     grows outward, nearly linear in the distance; along_edge(value) likewise, a number
// All that lies outside of the support must be exactly zero.
#if defined(RAMUS_FIELD_PLAIN_SUM_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef RAMUS_FIELD_PLAIN_SUM_INL_H
#undef RAMUS_FIELD_PLAIN_SUM_INL_H
#else
#define RAMUS_FIELD_PLAIN_SUM_INL_H
#endif

#include "core/field/sum/bounds-inl.h"
#include "core/field/sum/projection-inl.h"
#include "core/field/sum/sampling-inl.h"

HWY_BEFORE_NAMESPACE();
namespace ramus::field::HWY_NAMESPACE {

template <class Profile>
inline constexpr KernelFunctions kPlainSumFunctions{&sample_groups<Profile>, &sample_lattice<Profile>,
                                                    &project<Profile>,       &find_depths<Profile>,
                                                    &crossing<Profile>,      &bound_children<Profile>};

} // namespace ramus::field::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
