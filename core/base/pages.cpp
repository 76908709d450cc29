#include "core/base/pages.h"

#include "core/base/memory.h"

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <limits>
#include <mutex>
#include <new>
#include <sys/mman.h>
#include <utility>
#include <vector>

namespace ramus {

namespace {

constexpr std::size_t kPage = 4096;
constexpr std::size_t kLargePage = std::size_t{2} << 20;

std::uintptr_t address(const void* memory) { return reinterpret_cast<std::uintptr_t>(memory); }

std::size_t whole(std::size_t bytes, std::size_t page) { return (bytes + page - 1) / page * page; }

bool has_large_pages(std::size_t bytes) { return bytes >= 2 * kLargePage; }

std::size_t size_of(std::size_t bytes) { return whole(bytes, has_large_pages(bytes) ? kLargePage : kPage); }

// But not for the last, which would be filled in part only.
void ask_for_large_pages([[maybe_unused]] void* memory, [[maybe_unused]] std::size_t bytes) {
#ifdef MADV_HUGEPAGE
    madvise(memory, bytes / kLargePage * kLargePage, MADV_HUGEPAGE); // a hint only
#endif
}

void* map(std::size_t bytes) {
    // Not all that is asked for is written at the same time (paged_array.h), so none is set aside.
    void* memory = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    if (memory == MAP_FAILED) throw std::bad_alloc();
    return memory;
}

// Large pages begin at their own multiples.
void* map_large(std::size_t bytes) {
    const std::size_t mapped = bytes + kLargePage;
    void* memory = map(mapped);
    const std::uintptr_t begin = address(memory);
    const std::uintptr_t aligned = whole(begin, kLargePage);
    const std::uintptr_t end = aligned + bytes;
    if (aligned > begin) munmap(memory, aligned - begin);
    if (end < begin + mapped) munmap(reinterpret_cast<void*>(end), begin + mapped - end);
    return reinterpret_cast<void*>(aligned);
}

// Stretches of pages that nobody uses now.
class KeptPages {
public:
    explicit KeptPages(double limit_bytes) : limit_(static_cast<std::size_t>(limit_bytes)) {}

    // Out of the shortest that is long enough; null: none is. What is made anew asks for the lengths that it had
    // before, and finds the very pages that it wrote then, as long as neighbours are put together only where nothing
    // else helps.
    void* take(std::size_t bytes) {
        const std::scoped_lock lock(mutex_);
        auto best = shortest(bytes);
        if (best == stretches_.end()) {
            put_neighbours_together();
            best = shortest(bytes);
        }
        if (best == stretches_.end()) return nullptr;
        std::byte* memory = best->begin;
        bytes_ -= bytes;
        *best = {best->begin + bytes, best->bytes - bytes};
        if (best->bytes == 0) stretches_.erase(best);
        return memory;
    }

    void keep(void* memory, std::size_t bytes) {
        const std::scoped_lock lock(mutex_);
        if (bytes_ + bytes > limit_ || !lend(memory, bytes)) {
            munmap(memory, bytes);
            return;
        }
        stretches_.push_back({static_cast<std::byte*>(memory), bytes});
        bytes_ += bytes;
    }

    // At least so many bytes go back to the system, if there are, in whole stretches.
    void release(std::size_t bytes) {
        const std::scoped_lock lock(mutex_);
        std::size_t gone = 0;
        auto end = stretches_.begin();
        for (; end != stretches_.end() && gone < bytes; ++end) {
            munmap(end->begin, end->bytes);
            gone += end->bytes;
        }
        stretches_.erase(stretches_.begin(), end);
        bytes_ -= gone;
    }

    std::size_t resident_bytes() {
        const std::scoped_lock lock(mutex_);
        std::size_t pages = 0;
        std::vector<unsigned char> resident;
        for (const Stretch& s : stretches_) {
            resident.assign(s.bytes / kPage, 0);
            if (mincore(s.begin, s.bytes, resident.data()) != 0) continue;
            pages += static_cast<std::size_t>(std::ranges::count_if(resident, [](auto r) { return (r & 1U) != 0; }));
        }
        return pages * kPage;
    }

private:
    struct Stretch {
        std::byte* begin;
        std::size_t bytes;
    };

    std::vector<Stretch>::iterator shortest(std::size_t bytes) {
        auto best = stretches_.end();
        for (auto s = stretches_.begin(); s != stretches_.end(); ++s)
            if (s->bytes >= bytes && (best == stretches_.end() || s->bytes < best->bytes)) best = s;
        return best;
    }

    void put_neighbours_together() {
        std::ranges::sort(stretches_, {}, &Stretch::begin);
        std::vector<Stretch> together;
        for (const Stretch& s : stretches_) {
            if (!together.empty() && together.back().begin + together.back().bytes == s.begin)
                together.back().bytes += s.bytes;
            else
                together.push_back(s);
        }
        stretches_ = std::move(together);
    }

    // The system may take the pages, and they stay as they are until it does.
    static bool lend([[maybe_unused]] void* memory, [[maybe_unused]] std::size_t bytes) {
#ifdef MADV_FREE
        return madvise(memory, bytes, MADV_FREE) == 0;
#else
        return false;
#endif
    }

    std::mutex mutex_;
    std::vector<Stretch> stretches_;
    std::size_t bytes_ = 0;
    const std::size_t limit_;
};

// Those of large pages, and the others. They outlive every array.
KeptPages& kept_pages(bool large) {
    static auto* const large_pages = new KeptPages(0.5 * memory_limit(0.0));
    static auto* const small_pages = new KeptPages(64e6);
    return large ? *large_pages : *small_pages;
}

// Before fresh pages come.
void make_way_for(std::size_t bytes) { kept_pages(has_large_pages(bytes)).release(bytes); }

} // namespace

void* take_pages(std::size_t bytes) {
    const std::size_t size = size_of(bytes);
    const bool large = has_large_pages(bytes);
    void* memory = kept_pages(large).take(size);
    if (memory == nullptr) {
        make_way_for(size);
        memory = large ? map_large(size) : map(size);
    }
    if (large) ask_for_large_pages(memory, bytes);
    return memory;
}

void give_pages_back(void* memory, std::size_t bytes) {
    const std::size_t size = size_of(bytes);
    const bool large = has_large_pages(bytes);
    if (!large || address(memory) % kLargePage == 0)
        kept_pages(large).keep(memory, size);
    else
        munmap(memory, size);
}

void* stretch_pages(void* memory, std::size_t bytes, std::size_t more_bytes) {
    const std::size_t size = size_of(more_bytes);
    make_way_for(size - size_of(bytes));
    void* stretched = mremap(memory, size_of(bytes), size, MREMAP_MAYMOVE);
    if (stretched == MAP_FAILED) {
        if (errno != EFAULT) throw std::bad_alloc();
        // Neighbours kept together that the system has apart.
        stretched = take_pages(more_bytes);
        std::memcpy(stretched, memory, bytes);
        give_pages_back(memory, bytes);
    }
    if (has_large_pages(more_bytes)) ask_for_large_pages(stretched, more_bytes);
    return stretched;
}

void empty_pages(void* memory, std::size_t bytes) {
    const std::uintptr_t first = whole(address(memory), kPage);
    const std::uintptr_t end = (address(memory) + bytes) / kPage * kPage;
    if (end > first) madvise(reinterpret_cast<void*>(first), end - first, MADV_DONTNEED);
}

void* take_zero_pages(std::size_t bytes) {
    make_way_for(size_of(bytes));
    void* memory = map(size_of(bytes));
#ifdef MADV_NOHUGEPAGE
    madvise(memory, size_of(bytes), MADV_NOHUGEPAGE); // one value in a large page would fill all of it
#endif
    return memory;
}

void give_zero_pages_back(void* memory, std::size_t bytes) { munmap(memory, size_of(bytes)); }

std::size_t kept_page_bytes() { return kept_pages(false).resident_bytes() + kept_pages(true).resident_bytes(); }

void let_kept_pages_go() {
    for (const bool large : {false, true}) kept_pages(large).release(std::numeric_limits<std::size_t>::max());
}

} // namespace ramus
