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

// Like array.resize(count) for an empty array, on large pages where they pay.
template <class T> void resize_large(std::vector<T>& array, std::size_t count) {
    array.reserve(count);
#ifdef __linux__
    constexpr std::uintptr_t kPage = std::uintptr_t{2} << 20;
    const auto begin = (reinterpret_cast<std::uintptr_t>(array.data()) + kPage - 1) / kPage * kPage;
    const auto end = reinterpret_cast<std::uintptr_t>(array.data() + array.capacity()) / kPage * kPage;
    if (begin < end) madvise(reinterpret_cast<void*>(begin), end - begin, MADV_HUGEPAGE);
#endif
    array.resize(count);
}

} // namespace ramus
