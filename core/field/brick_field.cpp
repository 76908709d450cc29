#include "core/field/brick_field.h"

#include "core/field/cut_ends.h"

#include <algorithm>

namespace ramus::field {

void Projection::grow(std::size_t capacity) {
    for (auto* array : {&x, &y, &z, &cx, &cy, &cz, &reach}) array->resize(capacity);
}

void Projection::pad() {
    const std::size_t padded = size_ + kProjectionPadding;
    if (x.size() < padded) grow(padded);
    for (auto* array : {&x, &y, &z, &cx, &cy, &cz, &reach})
        std::fill_n(array->begin() + static_cast<std::ptrdiff_t>(size_), kProjectionPadding, (*array)[size_ - 1]);
}

void BrickField::flatten(const SurfacePoints& points, std::size_t count) const {
    if (cut_ends_ != nullptr) flatten_ends(*cut_ends_, points, count);
}

} // namespace ramus::field
