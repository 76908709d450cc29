#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/field/local_segments.cpp"
// clang-format off: foreach_target compiles this file once per instruction set and must come first.
#include <hwy/foreach_target.h>
// clang-format on
#include "core/field/local_segments.h"
#include "core/field/reaching-inl.h"

#include <algorithm>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace ramus::field::HWY_NAMESPACE {
void GatherSegments(LocalSegments& local) {
    const FieldSegment* segments = local.field->segments().data();
    for (std::size_t m = 0; m < local.count; ++m) {
        const FieldSegment& s = segments[local.list[m]];
        float* table = local.tables.data() + m * LocalSegments::kTableStride;
        subtract(local.axes.x, s.ax, table);
        subtract(local.axes.y, s.ay, table + 8);
        subtract(local.axes.z, s.az, table + 16);
        local.x[m] = -table[0], local.y[m] = -table[8], local.z[m] = -table[16];
        local.ux[m] = s.ux, local.uy[m] = s.uy, local.uz[m] = s.uz;
        local.length[m] = s.length, local.radius[m] = s.radius, local.slope[m] = s.slope;
        local.branch[m] = s.branch;
    }
}

} // namespace ramus::field::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace ramus::field {

HWY_EXPORT(GatherSegments);

void gather_segments(const ConvolutionField& field, std::span<const std::uint32_t> list, const GridAxes& axes,
                     LocalSegments& local) {
    local.field = &field;
    local.axes = axes;
    local.count = list.size();
    local.list = list;
    constexpr std::size_t kWidestVector = 16;
    if (const std::size_t room = list.size() + kWidestVector; room > local.x.size()) {
        const std::size_t capacity = 2 * room;
        for (auto* array : {&local.x, &local.y, &local.z, &local.ux, &local.uy, &local.uz, &local.length, &local.radius,
                            &local.slope})
            array->resize(capacity);
        local.branch.resize(capacity);
        local.tables.resize(capacity * LocalSegments::kTableStride);
        local.reaching.resize(LocalSegments::kBoxes * capacity);
    }
    HWY_DYNAMIC_DISPATCH(GatherSegments)(local);
}

} // namespace ramus::field
#endif
