// The field of what is near a cone, two of its pieces at a time. Included once per instruction set.
#if defined(RAMUS_CASTER_NEAR_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef RAMUS_CASTER_NEAR_INL_H
#undef RAMUS_CASTER_NEAR_INL_H
#else
#define RAMUS_CASTER_NEAR_INL_H
#endif

#include "core/field/kernels/gaussian-inl.h"
#include "render/caster/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace ramus::render::caster::HWY_NAMESPACE {
namespace kernel = ramus::field::HWY_NAMESPACE;

// Calls call(i, pair, foot) for the pieces list[i] and list[i + 1] from the first to before the last, as seen from
// `at`.
template <class Call>
HWY_INLINE void for_pieces(const Field& field, const std::uint32_t* list, std::uint32_t first, std::uint32_t last,
                           V3 at, const Call& call) {
    const auto root_width = kernel::set(kernel::PackTag<2>(), field.root_width);
    for (std::uint32_t i = first; i < last; i += 2) {
        const Piece &a = field.pieces[list[i]], &b = field.pieces[list[i + 1]];
        const auto both = [](float x, float y) { return kernel::Pack<2>{set(x), set(y)}; };
        const kernel::Segments<2> pair{both(a.way[0], b.way[0]), both(a.way[1], b.way[1]), both(a.way[2], b.way[2]),
                                       both(a.length, b.length), both(a.radius, b.radius), both(a.slope, b.slope)};
        const auto from = [&](V x, int c) {
            return kernel::Pack<2>{hn::Sub(x, set(a.from[c])), hn::Sub(x, set(b.from[c]))};
        };
        call(i, pair, kernel::find_foot(pair, root_width, from(at.x, 0), from(at.y, 1), from(at.z, 2)));
    }
}

} // namespace ramus::render::caster::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
