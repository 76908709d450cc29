// UnsetArray: memory for many plain values that will all be written before they are read, so that nothing is spent on
// setting them first. On large pages where they pay.
#pragma once

#include "core/base/huge_pages.h"

#include <cstddef>
#include <memory>
#include <type_traits>

namespace ramus {

template <class T> class UnsetArray {
    static_assert(std::is_trivially_copyable_v<T> && std::is_trivially_default_constructible_v<T>);

public:
    UnsetArray() = default;
    explicit UnsetArray(std::size_t size) : values_(std::make_unique_for_overwrite<T[]>(size)), size_(size) {
        prefer_huge_pages(values_.get(), size * sizeof(T));
    }
    [[nodiscard]] T& operator[](std::size_t i) { return values_[i]; }
    [[nodiscard]] const T& operator[](std::size_t i) const { return values_[i]; }
    [[nodiscard]] std::size_t size() const { return size_; }

private:
    std::unique_ptr<T[]> values_;
    std::size_t size_ = 0;
};

} // namespace ramus
