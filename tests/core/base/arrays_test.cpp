// The arrays of core/base, and the memory that they give back.
#include "core/base/chunked_array.h"
#include "core/base/large_array.h"
#include "core/base/mapped_pages.h"
#include "core/base/memory.h"
#include "core/base/shared_pages.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <doctest/doctest.h>
#include <oneapi/tbb/parallel_for.h>
#include <set>
#include <sys/mman.h>

using namespace ramus;

namespace {

constexpr std::size_t kMiB = std::size_t{1} << 20;

} // namespace

TEST_CASE("memory that arrays gave back is no longer the process's after it is released") {
    release_unused_memory();
    const double before = process_memory();
    {
        LargeArray<std::uint8_t> array(32 * kMiB, std::uint8_t{1});
        CHECK(process_memory() - before > 31e6);
    }
    release_unused_memory();
    CHECK(process_memory() - before < 4e6);
}

TEST_CASE(
    "pages that are mapped again take memory once, until either side writes, and neither sees what the other wrote") {
    auto pages = SharedPages::make(64 * kMiB - 5);
    REQUIRE(pages != nullptr);
    REQUIRE(pages->bytes() == 64 * kMiB); // whole pages
    CHECK(std::all_of(pages->data(), pages->data() + pages->bytes(), [](std::byte b) { return b == std::byte{0}; }));
    std::memset(pages->data(), 7, pages->bytes());
    const double written = process_memory();
    pages->rest();
    CHECK(written - process_memory() > 60e6); // they are still there, and not counted

    auto* const again = static_cast<std::byte*>(pages->mapped_again());
    REQUIRE(again != nullptr);
    const double before = process_memory();
    CHECK(std::all_of(again, again + pages->bytes(), [](std::byte b) { return b == std::byte{7}; }));
    CHECK(process_memory() - before < 70e6);
    again[5 * kMiB] = std::byte{1};
    CHECK(pages->data()[5 * kMiB] == std::byte{7});
    CHECK(pages->data()[6 * kMiB] == std::byte{7});
    const std::size_t bytes = pages->bytes();
    pages.reset();
    CHECK(again[5 * kMiB] == std::byte{1}); // it outlasts what it is of
    CHECK(again[6 * kMiB] == std::byte{7});
    munmap(again, bytes);
}

TEST_CASE("a sparse array is zero where nothing was written, whatever was given back before") {
    { const LargeArray<std::uint8_t> used(16 * kMiB, std::uint8_t{0xAB}); }
    SparseArray<std::uint8_t> zeros;
    zeros.resize(16 * kMiB);
    CHECK(std::ranges::all_of(zeros, [](std::uint8_t v) { return v == 0; }));
}

TEST_CASE("a paged array keeps its values while it grows, and takes no memory for what is emptied") {
    PagedArray<std::uint32_t> numbers;
    for (std::size_t count = 1; count <= 16 * kMiB; count *= 4) {
        const std::size_t from = numbers.size();
        numbers.resize(count);
        for (std::size_t n = from; n < count; ++n) numbers[n] = static_cast<std::uint32_t>(n);
    }
    bool same = true;
    for (std::size_t n = 0; n < numbers.size(); ++n) same = same && numbers[n] == n;
    CHECK(same);
    const double before = process_memory();
    empty_pages(numbers.data(), numbers.size() * sizeof(std::uint32_t));
    CHECK(before - process_memory() > 60e6);
    numbers[5] = 5;
    CHECK(numbers[5] == 5);
}

TEST_CASE("threads take and give back arrays, and nobody shares one") {
    tbb::parallel_for(0, 400, [](int n) {
        const std::size_t bytes = (4 + static_cast<std::size_t>(n * 7 % 13)) * kMiB;
        LargeArray<int> mine(bytes / sizeof(int));
        for (std::size_t i = 0; i < mine.size(); i += 1024) mine[i] = n;
        bool all = true;
        for (std::size_t i = 0; i < mine.size(); i += 1024) all = all && mine[i] == n;
        CHECK(all);
    });
}

TEST_CASE("chunks that are done with serve the values that come next") {
    ChunkedArray<std::array<std::uint64_t, 16>> array;
    constexpr std::size_t kCount = 200'000;
    constexpr std::size_t kAtOnce = 1000;
    array.resize(kCount);
    std::set<const void*> addresses;
    bool kept = true;
    for (std::size_t first = 0; first < kCount; first += kAtOnce) {
        array.provide(first, first + kAtOnce);
        for (std::size_t n = first; n < first + kAtOnce; ++n) array[n].fill(n), addresses.insert(&array[n]);
        // The one before is still there.
        const std::size_t before = first < kAtOnce ? first : first - kAtOnce;
        for (std::size_t n = before; n < first + kAtOnce; ++n) kept = kept && array[n][15] == n;
        if (first > 0) array.release(before, first);
    }
    CHECK(kept);
    CHECK(addresses.size() < 5000);
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
