#include "core/base/memory.h"

#include "core/base/descriptor.h"
#include "core/base/words.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <fcntl.h>
#include <malloc.h>
#include <oneapi/tbb/scalable_allocator.h>
#include <unistd.h>

namespace ramus {

// Makes the allocator keep freed arrays of any size until release_unused_memory(). A new surface then reuses pages that
// the system would otherwise have to clear.
[[maybe_unused]] static const int kHugeArraysKept = scalable_allocation_mode(TBBMALLOC_SET_HUGE_SIZE_THRESHOLD, 0);

std::string megabytes(double bytes) {
    constexpr double kMostTold = 1e15; // above, llround() would overflow soon, and the digits carry no meaning
    return (bytes < 1e6 * kMostTold ? std::to_string(std::llround(bytes / 1e6)) : in_digits(bytes / 1e6, 3)) + " MB";
}

std::string takes_too_much(std::string_view what, double bytes, double left) {
    return std::string(what) + " takes " + megabytes(bytes) + " of memory; " + megabytes(left) + " are left to it";
}

double memory_limit(double asked) {
    if (asked > 0.0) return asked;
    return 0.5 * static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGE_SIZE));
}

namespace {

// Bytes of the process. `which`: 0 all, 1 resident, 2 resident pages of files.
double pages_of_process(std::size_t which) {
    // No stream, because DiskPages calls this every few milliseconds.
    const Descriptor statm(::open("/proc/self/statm", O_RDONLY | O_CLOEXEC));
    std::array<char, 128> text{};
    std::array<double, 3> pages{};
    if (::read(statm.number(), text.data(), text.size() - 1) <= 0 ||
        std::sscanf(text.data(), "%lf %lf %lf", &pages[0], &pages[1], &pages[2]) != 3)
        return 0.0;
    return pages[which] * static_cast<double>(sysconf(_SC_PAGE_SIZE));
}

} // namespace

double process_memory() { return pages_of_process(1); }
double process_file_memory() { return pages_of_process(2); }

double memory_left(double asked) {
    const double limit = memory_limit(asked);
    if (process_memory() > 0.5 * limit) release_unused_memory(); // unused memory counts as resident
    return std::max(1.0, limit - process_memory());
}

void release_unused_memory() {
    // Without a first allocation, the command reads an uninitialized key of thread-local data.
    scalable_free(scalable_malloc(1));
    (void)scalable_allocation_command(TBBMALLOC_CLEAN_ALL_BUFFERS, nullptr);
#ifdef __GLIBC__
    malloc_trim(0); // also frees pages between blocks in use
#endif
}

} // namespace ramus
