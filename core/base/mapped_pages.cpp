#include "core/base/mapped_pages.h"

#include <memory>
#include <new>
#include <sys/mman.h>

namespace ramus {

namespace {

constexpr std::size_t kPage = 4096;

std::size_t whole_pages(std::size_t bytes) { return (bytes + kPage - 1) / kPage * kPage; }

} // namespace

void* map_pages(std::size_t bytes) {
    // No memory is reserved, because most pages are never written.
    constexpr int kFlags = MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE;
    void* memory = mmap(nullptr, whole_pages(bytes), PROT_READ | PROT_WRITE, kFlags, -1, 0);
    if (memory == MAP_FAILED) throw std::bad_alloc();
#ifdef MADV_NOHUGEPAGE
    madvise(memory, whole_pages(bytes), MADV_NOHUGEPAGE);
#endif
    return memory;
}

void unmap_pages(void* memory, std::size_t bytes) { munmap(memory, whole_pages(bytes)); }

void empty_pages(void* memory, std::size_t bytes) {
    if (std::align(kPage, kPage, memory, bytes) != nullptr) madvise(memory, bytes / kPage * kPage, MADV_DONTNEED);
}

} // namespace ramus
