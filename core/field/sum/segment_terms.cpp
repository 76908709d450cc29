#include "core/field/kernel.h"

namespace ramus::field {

void SegmentTerms::clear(std::size_t most) {
    constexpr std::size_t kWidestVector = 16; // rows are read by whole vectors
    count = 0;
    const std::size_t stride = most + kWidestVector;
    if (stride <= stride_) return;
    stride_ = 2 * stride;
    numbers_.assign(kRows * stride_, 1.0F); // what lies beyond the last segment is a segment, too
    for (std::vector<double>& start : starts_) start.resize(stride_);
}

void SegmentTerms::add(const FieldSegment& segment) {
    starts_[0][count] = segment.ax, starts_[1][count] = segment.ay, starts_[2][count] = segment.az;
    row(kUx)[count] = segment.ux, row(kUy)[count] = segment.uy, row(kUz)[count] = segment.uz;
    row(kLength)[count] = segment.length, row(kRadius)[count] = segment.radius, row(kSlope)[count] = segment.slope;
    row(kBeyond)[count] = segment.beyond;
    ++count;
}

void SegmentTerms::see_from(const glm::dvec3& point) {
    for (int axis = 0; axis < 3; ++axis) {
        const double* const start = starts_[static_cast<std::size_t>(axis)].data();
        float* const from = row(static_cast<Numbers>(kX + axis));
        const double at = point[axis];
        for (std::size_t n = 0; n < count; ++n) from[n] = static_cast<float>(at - start[n]);
    }
}

} // namespace ramus::field
