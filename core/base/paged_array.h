// PagedArray: plain values in pages of their own, for arrays that grow at the end while what lies behind is done with.
// Growing moves no value, giving values up frees their pages, and what has not been written takes no memory.
#pragma once

#include "core/base/mapped_pages.h"

#include <algorithm>
#include <cstddef>
#include <span>
#include <type_traits>
#include <utility>

namespace ramus {

template <class T> class PagedArray {
    static_assert(std::is_trivially_copyable_v<T> && std::is_trivially_destructible_v<T>);

public:
    PagedArray() = default;
    PagedArray(const PagedArray&) = delete;
    PagedArray& operator=(const PagedArray&) = delete;
    ~PagedArray() {
        if (memory_ != nullptr) unmap_pages(memory_, capacity_ * sizeof(T));
    }

    // New values are unset. Addresses change.
    void resize(std::size_t count) {
        if (count > capacity_) {
            constexpr std::size_t kFirst = std::size_t{1} << 20;
            const std::size_t capacity = std::max({count, 2 * capacity_, kFirst});
            void* memory = memory_ == nullptr ? map_pages(capacity * sizeof(T), PageUse::kDense)
                                              : remap_pages(memory_, capacity_ * sizeof(T), capacity * sizeof(T));
            memory_ = static_cast<T*>(memory);
            capacity_ = capacity;
        }
        size_ = count;
    }
    [[nodiscard]] std::size_t size() const { return size_; }
    [[nodiscard]] T* data() { return memory_; }
    [[nodiscard]] std::span<const T> values() const { return {memory_, size_}; }
    [[nodiscard]] T& operator[](std::size_t n) { return memory_[n]; }

private:
    T* memory_ = nullptr;
    std::size_t size_ = 0, capacity_ = 0;
};

} // namespace ramus
