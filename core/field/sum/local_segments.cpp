#include "core/field/sum/local_segments.h"

namespace ramus::field {

void LocalSegments::enter(SegmentIndices segments_there, const GridAxes& axes_there) {
    axes = axes_there;
    count = segments_there.size();
    list = segments_there;
    constexpr std::size_t kWidestVector = 16;
    const std::size_t needed = count + kWidestVector;
    if (needed <= x.size()) return;
    const std::size_t capacity = 2 * needed;
    for (auto* array : {&x, &y, &z, &ux, &uy, &uz, &length, &radius, &slope, &beyond, &excess, &excess_slope})
        array->resize(capacity);
    branch.resize(capacity);
    tables.resize(capacity * kTableStride);
    reaching.resize(kBoxes * capacity);
}

} // namespace ramus::field
