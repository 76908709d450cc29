// The memory that a scan takes while it is read, whenever its values turn out to need a larger type.
#include "core/volume/voxel_store.h"
#include "tests/support/peak_memory.h"

#include <cmath>
#include <doctest/doctest.h>
#include <functional>
#include <vector>

using namespace ramus;

namespace {

constexpr std::size_t kSlice = std::size_t{256} * 256;
constexpr int kSlices = 500; // 33 million voxels
constexpr double kMib = 1024.0 * 1024.0;

struct Stored {
    volume::Volume volume;
    double peak_mib = 0.0;
};

// Stores slices of the values that `value(k, n)` gives, and checks some of them.
Stored stored_values(double memory_bytes, const std::function<float(int k, std::uint32_t n)>& value) {
    const test::PeakMemory peak;
    volume::VoxelStore store({256, 256, kSlices}, {memory_bytes}, "scan");
    std::vector<float> slice(kSlice);
    for (int k = 0; k < kSlices; ++k) {
        for (std::uint32_t n = 0; n < kSlice; ++n) slice[n] = value(k, n);
        REQUIRE(store.append(slice.data(), slice.size(), {}));
    }
    Stored stored;
    std::move(store).finish(stored.volume);
    stored.peak_mib = peak.grown_mib();
    for (int k = 0; k < kSlices; k += 7)
        for (std::uint32_t n = 0; n < kSlice; n += 97)
            if (const glm::ivec3 at(static_cast<int>(n % 256), static_cast<int>(n / 256), k);
                volume::value_at(stored.volume, at) != static_cast<double>(value(k, n)))
                FAIL("voxel " << n << " of slice " << k);
    return stored;
}

float noise(int k, std::uint32_t n) { // 0 to 255
    return static_cast<float>((n * 2654435761U + static_cast<std::uint32_t>(k) * 40503U) >> 24U);
}

} // namespace

TEST_CASE("a scan is in memory once, also where its type changes late" * doctest::test_suite("slow")) {
    constexpr double kOnce = static_cast<double>(kSlice) * kSlices / kMib, kMore = 16.0;
    // The limit lets an array of the final type fit, and no second one.
    const auto limit = [&](double bytes_each) { return (bytes_each * kOnce + kMore) * kMib; };
    SUBCASE("from 8 to 16 bits") {
        const Stored stored =
            stored_values(limit(2.0), [](int k, std::uint32_t n) { return noise(k, n) - (k > 450 ? 9 : 0); });
        CHECK(std::holds_alternative<SparseArray<std::int16_t>>(stored.volume.voxels));
        CHECK(stored.peak_mib < 2.0 * kOnce + kMore);
    }
    SUBCASE("from 16 to 32 bits") {
        const Stored stored = stored_values(limit(4.0), [](int k, std::uint32_t n) {
            return noise(k, n) - (k > 250 ? 9.0F : 0.0F) + (k > 480 ? 0.5F : 0.0F);
        });
        CHECK(std::holds_alternative<SparseArray<float>>(stored.volume.voxels));
        CHECK(stored.peak_mib < 4.0 * kOnce + kMore);
    }
    SUBCASE("from runs to single values") {
        const Stored stored =
            stored_values(limit(2.0), [](int k, std::uint32_t n) { // runs take almost half of the array
                return k > 450 ? noise(k, n) : 300.0F + noise(k, n / 5);
            });
        CHECK(std::holds_alternative<SparseArray<std::uint16_t>>(stored.volume.voxels));
        CHECK(stored.peak_mib < 2.0 * kOnce + kMore);
    }
}
