// Memory in whole pages: what is kept, what goes back, and the arrays on top of it.
#include "core/base/chunked_array.h"
#include "core/base/large_array.h"
#include "core/base/memory.h"
#include "core/base/paged_array.h"
#include "core/base/pages.h"
#include "core/base/sparse_array.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <doctest/doctest.h>
#include <oneapi/tbb/parallel_for.h>
#include <set>
#include <sys/mman.h>
#include <vector>

using namespace ramus;

namespace {

constexpr std::size_t kMiB = std::size_t{1} << 20;

} // namespace

TEST_CASE("pages given back serve what is asked for next, and do not count as used meanwhile") {
    let_kept_pages_go();
    const double before = process_memory();
    void* first = take_pages(32 * kMiB);
    std::memset(first, 1, 32 * kMiB);
    CHECK(process_memory() - before > 31e6);
    give_pages_back(first, 32 * kMiB);
    CHECK(kept_page_bytes() == 32 * kMiB);
    CHECK(process_memory() - before < 4e6);

    void* part = take_pages(20 * kMiB);
    CHECK(part == first);
    void* rest = take_pages(12 * kMiB);
    CHECK(rest == static_cast<std::byte*>(first) + 20 * kMiB);
    CHECK(kept_page_bytes() == 0);
    // Neighbours become one again.
    give_pages_back(rest, 12 * kMiB);
    give_pages_back(part, 20 * kMiB);
    void* whole = take_pages(32 * kMiB);
    CHECK(whole == first);
    give_pages_back(whole, 32 * kMiB);
    let_kept_pages_go();
    CHECK(kept_page_bytes() == 0);
}

TEST_CASE("fresh pages come only after as many kept ones have gone") {
    let_kept_pages_go();
    void* small = take_pages(16 * kMiB);
    std::memset(small, 1, 16 * kMiB);
    give_pages_back(small, 16 * kMiB);
    void* larger = take_pages(24 * kMiB);
    CHECK(kept_page_bytes() == 0);
    give_pages_back(larger, 24 * kMiB);
    CHECK(kept_page_bytes() == 0); // kept, but never written: they take nothing
    let_kept_pages_go();

    // So for stretches that grow, and for zeros.
    const auto keep_some = [] {
        void* memory = take_pages(16 * kMiB);
        std::memset(memory, 1, 16 * kMiB);
        give_pages_back(memory, 16 * kMiB);
        CHECK(kept_page_bytes() == 16 * kMiB);
    };
    void* grown = take_pages(4 * kMiB);
    keep_some();
    grown = stretch_pages(grown, 4 * kMiB, 12 * kMiB);
    CHECK(kept_page_bytes() == 0);
    give_pages_back(grown, 12 * kMiB);
    let_kept_pages_go();
    keep_some();
    void* zeros = take_zero_pages(8 * kMiB);
    CHECK(kept_page_bytes() == 0);
    give_zero_pages_back(zeros, 8 * kMiB);
}

TEST_CASE("no kept page turns up among zeros") {
    let_kept_pages_go();
    void* used = take_pages(16 * kMiB);
    std::memset(used, 0xAB, 16 * kMiB);
    give_pages_back(used, 16 * kMiB);
    SparseArray<std::uint8_t> zeros;
    zeros.resize(16 * kMiB);
    CHECK(std::ranges::all_of(zeros, [](std::uint8_t v) { return v == 0; }));
    let_kept_pages_go();
}

TEST_CASE("a stretched array has what it had, wherever its pages come from") {
    let_kept_pages_go();
    // Kept pages of two origins that lie side by side are one stretch to us, but not to the system.
    std::vector<void*> taken;
    for (int n = 0; n < 8; ++n) taken.push_back(take_pages(4 * kMiB));
    for (void* memory : taken) std::memset(memory, 0xFF, 4 * kMiB), give_pages_back(memory, 4 * kMiB);
    void* middle = take_pages(4 * kMiB);
    madvise(middle, 4 * kMiB, MADV_NOHUGEPAGE);
    give_pages_back(middle, 4 * kMiB);
    PagedArray<std::uint32_t> numbers;
    for (std::size_t count = 1; count <= 16 * kMiB; count *= 4) {
        const std::size_t from = numbers.size();
        numbers.resize(count);
        for (std::size_t n = from; n < count; ++n) numbers[n] = static_cast<std::uint32_t>(n);
    }
    bool kept = true;
    for (std::size_t n = 0; n < numbers.size(); ++n) kept = kept && numbers[n] == n;
    CHECK(kept);
    let_kept_pages_go();
}

TEST_CASE("threads take and give back pages, and nobody shares one") {
    tbb::parallel_for(0, 400, [](int n) {
        const std::size_t bytes = (4 + static_cast<std::size_t>(n * 7 % 13)) * kMiB;
        LargeArray<int> mine(bytes / sizeof(int));
        for (std::size_t i = 0; i < mine.size(); i += 1024) mine[i] = n;
        bool all = true;
        for (std::size_t i = 0; i < mine.size(); i += 1024) all = all && mine[i] == n;
        CHECK(all);
    });
    let_kept_pages_go();
}

TEST_CASE("chunks that are done with serve the values that come next") {
    ChunkedArray<std::array<std::uint64_t, 16>> array;
    constexpr std::size_t kCount = 200'000;
    constexpr std::size_t kAtOnce = 1000;
    array.resize(kCount);
    std::set<const void*> places;
    bool kept = true;
    for (std::size_t first = 0; first < kCount; first += kAtOnce) {
        array.provide(first, first + kAtOnce);
        for (std::size_t n = first; n < first + kAtOnce; ++n) array[n].fill(n), places.insert(&array[n]);
        // The one before is still there.
        const std::size_t before = first < kAtOnce ? first : first - kAtOnce;
        for (std::size_t n = before; n < first + kAtOnce; ++n) kept = kept && array[n][15] == n;
        if (first > 0) array.release(before, first);
    }
    CHECK(kept);
    CHECK(places.size() < 5000);
}

TEST_CASE("a chunked array grows without moving what it has") {
    ChunkedArray<int> array;
    array.resize(10);
    array.provide(0, 10);
    for (int n = 0; n < 10; ++n) array[static_cast<std::size_t>(n)] = n;
    const int* const there = &array[9];
    array.resize(1'000'000);
    array.provide(10, 1'000'000);
    CHECK(&array[9] == there);
    CHECK(array[9] == 9);
    CHECK(array.size() == 1'000'000);
}
