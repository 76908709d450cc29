// Large arrays on large pages: first touch of a page costs as much as filling it, and a page of 2 MB spares 511 of 512
// such first touches. A hint only; where the system declines nothing changes but time.
#pragma once

#include <cstddef>
#include <vector>

#ifdef __linux__
#include <cstdint>
#include <sys/mman.h>
#endif

namespace ramus {

inline void prefer_huge_pages([[maybe_unused]] void* memory, [[maybe_unused]] std::size_t bytes) {
#ifdef __linux__
    constexpr std::uintptr_t kPage = std::uintptr_t{2} << 20;
    const auto begin = (reinterpret_cast<std::uintptr_t>(memory) + kPage - 1) / kPage * kPage;
    const auto end = (reinterpret_cast<std::uintptr_t>(memory) + bytes) / kPage * kPage;
    if (begin < end) madvise(reinterpret_cast<void*>(begin), end - begin, MADV_HUGEPAGE);
#endif
}

// Like array.resize(count) for an empty array, on large pages where they pay.
template <class T> void resize_large(std::vector<T>& array, std::size_t count) {
    array.reserve(count);
    prefer_huge_pages(array.data(), array.capacity() * sizeof(T));
    array.resize(count);
}

} // namespace ramus
