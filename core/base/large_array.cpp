#include "core/base/large_array.h"

#include "core/base/paged_array.h"
#include "core/base/sparse_array.h"

#include <cstdint>
#include <sys/mman.h>

namespace ramus {

namespace {

constexpr std::size_t kLargePage = std::size_t{2} << 20;

constexpr std::size_t kPage = 4096;

std::size_t whole(std::size_t bytes, std::size_t page) { return (bytes + page - 1) / page * page; }

void ask_for_large_pages([[maybe_unused]] void* memory, [[maybe_unused]] std::size_t bytes) {
#ifdef MADV_HUGEPAGE
    madvise(memory, bytes, MADV_HUGEPAGE); // a hint only
#endif
}

} // namespace

void* take_pages(std::size_t bytes) {
    const bool large = bytes >= 2 * kLargePage;
    const std::size_t size = whole(bytes, kPage);
    // Large pages begin at their own multiples.
    const std::size_t mapped = large ? size + kLargePage : size;
    // Not all that is asked for is written at the same time (paged_array.h), so none is set aside.
    void* memory = mmap(nullptr, mapped, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    if (memory == MAP_FAILED) throw std::bad_alloc();
    if (!large) return memory;
    const auto begin = reinterpret_cast<std::uintptr_t>(memory);
    const std::uintptr_t aligned = whole(begin, kLargePage);
    const std::uintptr_t end = aligned + size;
    if (aligned > begin) munmap(memory, aligned - begin);
    if (end < begin + mapped) munmap(reinterpret_cast<void*>(end), begin + mapped - end);
    memory = reinterpret_cast<void*>(aligned);
    ask_for_large_pages(memory, size);
    return memory;
}

void* take_zero_pages(std::size_t bytes) {
    const std::size_t size = whole(bytes, kPage);
    void* memory = mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    if (memory == MAP_FAILED) throw std::bad_alloc();
#ifdef MADV_NOHUGEPAGE
    madvise(memory, size, MADV_NOHUGEPAGE); // one value in a large page would fill all of it
#endif
    return memory;
}

void give_pages_back(void* memory, std::size_t bytes) { munmap(memory, whole(bytes, kPage)); }

void* stretch_pages(void* memory, std::size_t bytes, std::size_t more_bytes) {
    const std::size_t size = whole(more_bytes, kPage);
    void* stretched = mremap(memory, whole(bytes, kPage), size, MREMAP_MAYMOVE);
    if (stretched == MAP_FAILED) throw std::bad_alloc();
    ask_for_large_pages(stretched, size);
    return stretched;
}

void empty_pages(void* memory, std::size_t bytes) {
    const auto begin = reinterpret_cast<std::uintptr_t>(memory);
    const std::uintptr_t first = whole(begin, kPage);
    const std::uintptr_t end = (begin + bytes) / kPage * kPage;
    if (end > first) madvise(reinterpret_cast<void*>(first), end - first, MADV_DONTNEED);
}

} // namespace ramus
