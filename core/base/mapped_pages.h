// Whole pages mapped from the system, for arrays of plain values that grow without being copied, or of which much is
// never written or given up early. Untouched, they take no memory; what is mapped is zero.
#pragma once

#include <algorithm>
#include <cstddef>
#include <new>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

namespace ramus {

// kSparse: small pages only, for one value in a large page would fill all of it.
enum class PageUse { kDense, kSparse };

// At least so many bytes; throws std::bad_alloc.
[[nodiscard]] void* map_pages(std::size_t bytes, PageUse use);
// The same as part of more, elsewhere maybe; throws std::bad_alloc.
[[nodiscard]] void* remap_pages(void* memory, std::size_t bytes, std::size_t more_bytes);
void unmap_pages(void* memory, std::size_t bytes);
// Whole pages among these bytes, of whatever memory, go back to the system; what was in them is lost. They may be
// written again.
void empty_pages(void* memory, std::size_t bytes);

// PagedArray: plain values in pages of their own, for arrays that grow at the end while what lies behind is done with.
// Growing moves no value, giving values up frees their pages, and what has not been written takes no memory.
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

// SparseArray: a std::vector for plain values most of which are 0. What has not been written since it was made by one
// resize() is 0 and takes no memory, by pages of 4 KB; reading there takes none either. Who fills it leaves zeros out.
template <class T> class SparseAllocator {
public:
    using value_type = T;
    SparseAllocator() = default;
    template <class U> explicit(false) SparseAllocator(const SparseAllocator<U>&) {}

    T* allocate(std::size_t count) { return static_cast<T*>(map_pages(count * sizeof(T), PageUse::kSparse)); }
    void deallocate(T* memory, std::size_t count) { unmap_pages(memory, count * sizeof(T)); }

    template <class U, class... Arguments> void construct(U* at, Arguments&&... arguments) {
        if constexpr (sizeof...(Arguments) > 0 || !std::is_trivially_copyable_v<U>)
            ::new (static_cast<void*>(at)) U(std::forward<Arguments>(arguments)...);
    }
    bool operator==(const SparseAllocator&) const = default;
};

template <class T> using SparseArray = std::vector<T, SparseAllocator<T>>;

// Writes `count` values of another type into fresh zeros at `to`, without touching what stays 0.
template <class To, class From> void copy_sparsely(const From* from, std::size_t count, To* to) {
    constexpr std::size_t kAtOnce = 4096 / sizeof(To);
    for (std::size_t first = 0; first < count; first += kAtOnce) {
        const std::size_t end = first + kAtOnce < count ? first + kAtOnce : count;
        bool any = false;
        for (std::size_t n = first; n < end; ++n) any |= from[n] != From(0);
        if (!any) continue;
        for (std::size_t n = first; n < end; ++n) to[n] = static_cast<To>(from[n]);
    }
}

} // namespace ramus
