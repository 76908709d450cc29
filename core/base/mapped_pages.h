// Whole pages mapped from the system, for arrays of plain values of which much is never written. Untouched, they take
// no memory; what is mapped is zero.
#pragma once

#include <cstddef>
#include <new>
#include <type_traits>
#include <utility>
#include <vector>

namespace ramus {

// At least so many bytes, in small pages, for one value in a large page would fill all of it. Throws std::bad_alloc.
[[nodiscard]] void* map_pages(std::size_t bytes);
void unmap_pages(void* memory, std::size_t bytes);
// Whole pages among these bytes, of whatever memory, go back to the system; what was in them is lost. They may be
// written again.
void empty_pages(void* memory, std::size_t bytes);

// SparseArray: a std::vector for plain values most of which are 0. What has not been written since it was made by one
// resize() is 0 and takes no memory, by pages of 4 KB; reading there takes none either. Who fills it leaves zeros out.
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
