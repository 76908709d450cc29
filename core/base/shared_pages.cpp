#include "core/base/shared_pages.h"

#include "core/base/free_in_background.h"

#include <sys/mman.h>
#include <unistd.h>

namespace ramus {

std::shared_ptr<const SharedPages> SharedPages::make(std::size_t bytes) {
#ifdef MFD_CLOEXEC
    const auto page = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
    const std::size_t whole = (bytes + page - 1) / page * page;
    const int file = memfd_create("ramus", MFD_CLOEXEC);
    if (file < 0) return nullptr;
    void* data = MAP_FAILED;
    if (whole > 0 && ftruncate(file, static_cast<off_t>(whole)) == 0)
        data = mmap(nullptr, whole, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
    if (data == MAP_FAILED) {
        close(file);
        return nullptr;
    }
    return std::shared_ptr<const SharedPages>(new SharedPages(file, static_cast<std::byte*>(data), whole));
#else
    return nullptr;
#endif
}

SharedPages::~SharedPages() {
    const auto free_all = [data = data_, bytes = bytes_, file = file_] {
        munmap(data, bytes);
        close(file);
    };
    constexpr std::size_t kMany = std::size_t{16} << 20;
    if (bytes_ < kMany)
        free_all();
    else
        free_in_background(free_all);
}

void* SharedPages::map_private_copy() const {
    void* again = mmap(nullptr, bytes_, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_NORESERVE, file_, 0);
    return again == MAP_FAILED ? nullptr : again;
}

// On a shared mapping MADV_DONTNEED drops only page table entries; the bytes stay in their file.
void SharedPages::release_resident() const { madvise(data_, bytes_, MADV_DONTNEED); }

} // namespace ramus
