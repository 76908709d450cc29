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

// What the allocator keeps of large arrays, of any size, until release_unused_memory(): a surface that is made again
// finds its pages, which the system would have to clear anew.
[[maybe_unused]] static const int kHugeArraysKept = scalable_allocation_mode(TBBMALLOC_SET_HUGE_SIZE_THRESHOLD, 0);

std::string megabytes(double bytes) {
    constexpr double kMostTold = 1e15; // beyond, digits say nothing, and whole numbers end
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

// Pages of the process: all, resident, of files.
double pages_of_process(std::size_t which) {
    // No stream: DiskPages asks often.
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
    if (process_memory() > 0.5 * limit) release_unused_memory(); // it would count as in use
    return std::max(1.0, limit - process_memory());
}

void release_unused_memory() {
    // Before the allocator's first block the command reads a key of thread-local data that may be another library's.
    scalable_free(scalable_malloc(1));
    (void)scalable_allocation_command(TBBMALLOC_CLEAN_ALL_BUFFERS, nullptr);
#ifdef __GLIBC__
    malloc_trim(0); // what lies between blocks in use as well
#endif
}

} // namespace ramus
