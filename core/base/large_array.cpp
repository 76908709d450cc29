#include "core/base/large_array.h"

#include <cstdint>
#include <sys/mman.h>

namespace ramus {

namespace {

constexpr std::size_t kLargePage = std::size_t{2} << 20;

std::size_t whole(std::size_t bytes, std::size_t page) { return (bytes + page - 1) / page * page; }

} // namespace

void* take_pages(std::size_t bytes) {
    const bool large = bytes >= 2 * kLargePage;
    const std::size_t size = whole(bytes, 4096);
    // Large pages begin at their own multiples.
    const std::size_t mapped = large ? size + kLargePage : size;
    void* memory = mmap(nullptr, mapped, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (memory == MAP_FAILED) throw std::bad_alloc();
    if (!large) return memory;
    const auto begin = reinterpret_cast<std::uintptr_t>(memory);
    const std::uintptr_t aligned = whole(begin, kLargePage);
    const std::uintptr_t end = aligned + size;
    if (aligned > begin) munmap(memory, aligned - begin);
    if (end < begin + mapped) munmap(reinterpret_cast<void*>(end), begin + mapped - end);
    memory = reinterpret_cast<void*>(aligned);
#ifdef MADV_HUGEPAGE
    madvise(memory, size, MADV_HUGEPAGE); // a hint only
#endif
    return memory;
}

void give_pages_back(void* memory, std::size_t bytes) { munmap(memory, whole(bytes, 4096)); }

} // namespace ramus
