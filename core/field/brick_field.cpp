#include "core/field/brick_field.h"

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

} // namespace ramus::field
