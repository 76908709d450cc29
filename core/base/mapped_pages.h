// SparseArray: a std::vector for plain values of which most are never written. Its pages come directly from the system:
// they are 0, and take no memory before the first write.
#pragma once

#include <cstddef>
#include <new>
#include <type_traits>
#include <utility>
#include <vector>

namespace ramus {

// Maps at least `bytes` bytes, all 0. Uses small pages: a single value would fill all of a large one. Throws
// std::bad_alloc. The system may find no memory at a later write, because none is reserved.
[[nodiscard]] void* map_pages(std::size_t bytes);
void unmap_pages(void* memory, std::size_t bytes);
// Returns the whole pages within these bytes to the system. Their content is lost; they read as 0 and may be written
// again. For private memory of any allocator.
void empty_pages(void* memory, std::size_t bytes);

// After a single resize() of an empty array, all values are 0, and a page of 4 KB takes no memory before the first
// write to it. Reading takes none either. So code that fills the array should skip zeros (copy_sparsely()). A second
// resize() that moves the array copies all pages.
template <class T> class SparseAllocator {
public:
    using value_type = T;
    SparseAllocator() = default;
    template <class U> explicit(false) SparseAllocator(const SparseAllocator<U>&) {}

    T* allocate(std::size_t count) { return static_cast<T*>(map_pages(count * sizeof(T))); }
    void deallocate(T* memory, std::size_t count) { unmap_pages(memory, count * sizeof(T)); }

    template <class U, class... Arguments> void construct(U* at, Arguments&&... arguments) {
        if constexpr (sizeof...(Arguments) > 0 || !std::is_trivially_copyable_v<U>)
            ::new (static_cast<void*>(at)) U(std::forward<Arguments>(arguments)...);
    }
    bool operator==(const SparseAllocator&) const = default;
};

template <class T> using SparseArray = std::vector<T, SparseAllocator<T>>;

// Converts `count` values into `to`, which must be all 0. Does not write blocks of 4 KB that stay 0.
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
