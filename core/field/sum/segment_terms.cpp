#include "core/field/kernel.h"

#include <algorithm>

namespace ramus::field {

void SegmentTerms::clear(std::size_t most) {
    constexpr std::size_t kWidestVector = 16; // rows are read by whole vectors
    count = 0;
    const std::size_t stride = most + kWidestVector;
    if (stride <= stride_) return;
    stride_ = 2 * stride;
    numbers_.assign(kRows * stride_, 1.0F); // what lies beyond the last segment is a segment, too
}

void SegmentTerms::add(const FieldSegment& segment, const glm::dvec3& point) {
    const auto put = [&](Numbers numbers, double number) { row(numbers)[count] = static_cast<float>(number); };
    put(kX, point.x - segment.ax), put(kY, point.y - segment.ay), put(kZ, point.z - segment.az);
    row(kUx)[count] = segment.ux, row(kUy)[count] = segment.uy, row(kUz)[count] = segment.uz;
    row(kLength)[count] = segment.length, row(kRadius)[count] = segment.radius, row(kSlope)[count] = segment.slope;
    row(kBeyond)[count] = segment.beyond;
    ++count;
}

} // namespace ramus::field
