#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/field/sum/local_segments.cpp"
// clang-format off: foreach_target compiles this file once per instruction set and must come first.
#include <hwy/foreach_target.h>
// clang-format on
#include "core/field/sum/local_segments.h"
#include "core/field/sum/reaching-inl.h"

#include <algorithm>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace ramus::field::HWY_NAMESPACE {

void gather_segments(LocalSegments& local) {
    for (std::size_t m = 0; m < local.count; ++m) {
        const FieldSegment& s = local.segments[local.list[m]];
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

const char* instruction_set() { return hwy::TargetName(HWY_TARGET); }

} // namespace ramus::field::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace ramus::field {

HWY_EXPORT(gather_segments);
HWY_EXPORT(instruction_set);

void gather_segments(std::span<const std::uint32_t> list, const GridAxes& axes, LocalSegments& local) {
    local.axes = axes;
    local.count = list.size();
    local.list = list;
    constexpr std::size_t kWidestVector = 16;
    if (const std::size_t needed = list.size() + kWidestVector; needed > local.x.size()) {
        const std::size_t capacity = 2 * needed;
        for (auto* array : {&local.x, &local.y, &local.z, &local.ux, &local.uy, &local.uz, &local.length, &local.radius,
                            &local.slope})
            array->resize(capacity);
        local.branch.resize(capacity);
        local.tables.resize(capacity * LocalSegments::kTableStride);
        local.reaching.resize(LocalSegments::kBoxes * capacity);
    }
    HWY_DYNAMIC_DISPATCH(gather_segments)(local);
}

const char* instruction_set() { return HWY_DYNAMIC_DISPATCH(instruction_set)(); }

} // namespace ramus::field
#endif
