// The field around a cone, two segments at a time. Included once per instruction set.
#if defined(RAMUS_CASTER_LOCAL_FIELD_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef RAMUS_CASTER_LOCAL_FIELD_INL_H
#undef RAMUS_CASTER_LOCAL_FIELD_INL_H
#else
#define RAMUS_CASTER_LOCAL_FIELD_INL_H
#endif

#include "core/field/kernels/gaussian-inl.h"
#include "render/caster/glsl-inl.h"

HWY_BEFORE_NAMESPACE();
namespace ramus::render::caster::HWY_NAMESPACE {
namespace kernel = ramus::field::HWY_NAMESPACE;

// Calls call(i, pair, foot) for the segments list[i] and list[i + 1] from the first to before the last, as seen from
// `at`.
template <class Call>
HWY_INLINE void for_neighbours(const Field& field, const std::uint32_t* list, std::uint32_t first, std::uint32_t last,
                               Vec3 at, const Call& call) {
    const auto root_width = kernel::set(kernel::PackTag<2>(), field.root_width);
    for (std::uint32_t i = first; i < last; i += 2) {
        const FieldSegment &a = field.segments[list[i]], &b = field.segments[list[i + 1]];
        const auto both = [](float x, float y) { return kernel::Pack<2>{set(x), set(y)}; };
        const kernel::Segments<2> pair{both(a.direction[0], b.direction[0]),
                                       both(a.direction[1], b.direction[1]),
                                       both(a.direction[2], b.direction[2]),
                                       both(a.length, b.length),
                                       both(a.radius, b.radius),
                                       both(a.slope, b.slope)};
        const auto from = [&](Float x, int c) { return kernel::Pack<2>{(x - a.from[c]).v, (x - b.from[c]).v}; };
        call(i, pair, kernel::find_foot(pair, root_width, from(at.x, 0), from(at.y, 1), from(at.z, 2)));
    }
}

} // namespace ramus::render::caster::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
