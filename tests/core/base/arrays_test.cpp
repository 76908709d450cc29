// The arrays of core/base, and the memory that they give back.
#include "core/base/chunked_array.h"
#include "core/base/disk_pages.h"
#include "core/base/large_array.h"
#include "core/base/mapped_pages.h"
#include "core/base/memory.h"
#include "core/base/numbers_where.h"
#include "core/base/shared_pages.h"
#include "tests/support/temporary_folder.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstring>
#include <doctest/doctest.h>
#include <oneapi/tbb/parallel_for.h>
#include <set>
#include <stdexcept>
#include <string>
#include <sys/mman.h>
#include <thread>

using namespace ramus;

namespace {

constexpr std::size_t kMiB = std::size_t{1} << 20;

} // namespace

TEST_CASE("numbers that meet a condition are found in order, whatever their count") {
    for (const std::uint32_t count : {0U, 1U, 65'535U, 65'536U, 65'537U, 300'000U})
        for (const std::uint32_t every : {1U, 7U, 100'000U, 1'000'000U}) {
            LargeArray<std::uint32_t> expected;
            for (std::uint32_t n = every / 2; n < count; n += every) expected.push_back(n);
            CHECK(numbers_where(count, [&](std::uint32_t n) { return n % every == every / 2; }) == expected);
        }
}

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
    pages->release_resident();
    CHECK(written - process_memory() > 60e6); // they are still there, and not counted

    auto* const again = static_cast<std::byte*>(pages->map_private_copy());
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

TEST_CASE("arrays on the disk keep their values while their memory is dropped, and leave no file") {
    const TemporaryFolder folder;
    const double most = process_memory() + 20e6;
    const auto pages = std::make_shared<DiskPages>(folder.path() / "target", most);
    const LargeAllocator<std::byte> memory(pages);
    LargeArray<std::uint32_t> numbers(16 * kMiB, memory), few(16, memory);
    for (std::size_t n = 0; n < numbers.size(); ++n) numbers[n] = static_cast<std::uint32_t>(n);
    for (int looks = 0; looks < 1000 && process_memory() > most; ++looks)
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    CHECK(process_memory() <= most);
    CHECK(folder.names().empty());
    const LargeArray<std::uint32_t> copy(numbers);
    CHECK(copy.get_allocator().memory() == pages);
    const LargeArray<std::uint32_t> moved = std::move(numbers);
    numbers = few;
    bool same = moved.size() == copy.size();
    for (std::size_t n = 0; n < moved.size(); ++n) same = same && moved[n] == n && copy[n] == n;
    CHECK(same);
}

TEST_CASE("a disk that is too small for an array is an error that names it") {
    const TemporaryFolder folder;
    const std::string target = (folder.path() / "target").string();
    const LargeAllocator<float> memory(std::make_shared<DiskPages>(target, 1e9));
    std::string what;
    try {
        LargeArray<float> floats(std::size_t{1} << 50, memory);
    } catch (const std::runtime_error& error) {
        what = error.what();
    }
    CHECK(what.starts_with(target + ": this needs 4.5e+06 GB or more on the disk of " + folder.path().string()));
    CHECK(what.find("nothing was written") != std::string::npos);
    CHECK(folder.names().empty());
}

TEST_CASE("threads take and give back arrays, and nobody shares one" * doctest::test_suite("slow")) {
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
