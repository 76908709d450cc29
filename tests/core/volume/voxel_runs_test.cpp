// Values of masks kept as runs of equal ones: the same values, whatever they are kept in, in less memory.
#include "core/base/memory.h"
#include "core/volume/bit_mask.h"
#include "core/volume/isosurface.h"
#include "core/volume/label_counts.h"
#include "core/volume/voxel_store.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <doctest/doctest.h>
#include <limits>
#include <random>
#include <string>
#include <utility>
#include <vector>

using namespace ramus;

namespace {

// Runs of random lengths, most of them of 0; their mean is `mean`.
std::vector<std::uint16_t> values_in_runs(std::size_t count, double mean, int labels, unsigned seed) {
    std::mt19937 random(seed);
    std::geometric_distribution<std::size_t> length(1.0 / mean);
    std::vector<std::uint16_t> values;
    while (values.size() < count) {
        const auto value =
            static_cast<std::uint16_t>(random() % 3 == 0 ? 1 + random() % static_cast<unsigned>(labels) : 0);
        values.resize(std::min(count, values.size() + 1 + length(random)), value);
    }
    return values;
}

template <class Raw>
volume::Volume stored(const glm::ivec3& size, const std::vector<Raw>& values, std::size_t at_once,
                      const volume::Scaling& scaling = {}) {
    volume::VoxelStore store(size, {1e9}, "test");
    for (std::size_t n = 0; n < values.size(); n += at_once)
        REQUIRE(store.append(values.data() + n, std::min(at_once, values.size() - n), scaling));
    volume::Volume volume;
    std::move(store).finish(volume);
    return volume;
}

bool are_runs(const volume::Volume& volume) { return std::holds_alternative<volume::VoxelRuns>(volume.voxels); }

// The same values one by one.
volume::Volume one_by_one(const volume::Volume& volume) {
    volume::Volume other = volume;
    SparseArray<std::int32_t> array;
    array.resize(volume::voxel_count(volume.size));
    for (std::size_t n = 0; n < array.size(); ++n)
        array[n] = std::visit([&](const auto& values) { return static_cast<std::int32_t>(values[n]); }, volume.voxels);
    other.voxels = std::move(array);
    return other;
}

} // namespace

TEST_CASE("runs give every value back, one by one and from anywhere to anywhere") {
    // Longer and shorter than the blocks of 65536 in which runs begin anew.
    const auto values = values_in_runs(300'000, 900.0, 500, 1);
    volume::VoxelRuns runs;
    for (std::size_t n = 0; n < values.size();) {
        const std::size_t part = std::min<std::size_t>(1 + n % 7, values.size() - n);
        for (std::size_t k = 0; k < part; ++k) runs.add(values[n + k], 1);
        n += part;
    }
    runs.add(9, 200'000);
    REQUIRE(runs.size() == 500'000);
    bool same = true;
    for (std::size_t n = 0; n < runs.size(); ++n) same = same && runs[n] == (n < values.size() ? values[n] : 9);
    CHECK(same);
    std::mt19937 random(2);
    for (int n = 0; n < 200; ++n) {
        const std::size_t first = random() % runs.size(), end = first + random() % (runs.size() - first + 1);
        std::size_t at = first;
        bool right = true;
        runs.for_runs(first, end, [&](std::size_t begin, std::size_t stop, std::uint16_t value) {
            right = right && begin == at && stop > begin;
            for (; at < stop; ++at) right = right && value == runs[at];
        });
        CHECK(right);
        CHECK(at == end);
    }
}

TEST_CASE("a mask is kept as runs whatever type its file has, and counts and surfaces are those of its values") {
    const glm::ivec3 size(97, 53, 31);
    const auto values = values_in_runs(std::size_t{97} * 53 * 31, 20.0, 3, 3);
    const volume::Volume mask = stored(size, values, 1000);
    CHECK(are_runs(mask));
    CHECK(mask.minimum == 0.0);
    CHECK(mask.maximum == 3.0);
    const volume::Volume plain = one_by_one(mask);
    const auto equal = [&](const volume::Volume& other) {
        using Array = SparseArray<std::int32_t>;
        return are_runs(other) && std::get<Array>(one_by_one(other).voxels) == std::get<Array>(plain.voxels) &&
               other.minimum == 0.0 && other.maximum == 3.0;
    };
    CHECK(equal(stored(size, std::vector<std::int16_t>(values.begin(), values.end()), 777)));
    CHECK(equal(stored(size, std::vector<float>(values.begin(), values.end()), 100'000)));
    std::vector<double> halves(values.begin(), values.end());
    for (double& value : halves) value = (value - 5.0) / 2.0;
    CHECK(equal(stored(size, halves, 4096, {2.0, 5.0})));

    CHECK(volume::label_counts(mask) == volume::label_counts(plain));
    CHECK(volume::count_from(mask, 1.5) == volume::count_from(plain, 1.5));
    Job job;
    const JobRange all(job, 0.0F, 1.0F);
    const std::vector<volume::Selection> selections = {
        {}, {{2}, std::nullopt}, {{1, 3}, std::nullopt}, {{0}, std::nullopt}, {{}, 1.5}, {{}, 0.0}};
    for (const volume::Selection& selection : selections) {
        const auto one = volume::inside(mask, selection, all), other = volume::inside(plain, selection, all);
        REQUIRE(one);
        REQUIRE(other);
        bool same = true;
        for (int k = 0; k < size.z; ++k)
            for (int j = 0; j < size.y; ++j) same = same && std::ranges::equal(one->row(j, k), other->row(j, k));
        CHECK(same);
        const auto surface = volume::isosurface(mask, selection, {}, job);
        REQUIRE(surface);
        CHECK(surface == *volume::isosurface(plain, selection, {}, job));
    }
    CHECK_FALSE(volume::inside(mask, {{4}, std::nullopt}, all));
    CHECK_FALSE(volume::inside(mask, {{-1}, std::nullopt}, all));
}

TEST_CASE("what is no mask is kept one by one, however late that shows") {
    const glm::ivec3 size(100, 100, 100);
    std::vector<float> values(1'000'000, 7.0F);
    const auto check = [&](std::size_t at, float value) {
        std::vector<float> changed = values;
        changed[at] = value;
        for (const std::size_t at_once : {std::size_t{999}, std::size_t{1'000'000}}) {
            const volume::Volume volume = stored(size, changed, at_once);
            CHECK_FALSE(are_runs(volume));
            bool same = true;
            for (std::size_t n = 0; n < changed.size(); ++n)
                same =
                    same && volume::value_at(volume, {static_cast<int>(n % 100), static_cast<int>(n / 100 % 100),
                                                      static_cast<int>(n / 10'000)}) == static_cast<double>(changed[n]);
            CHECK(same);
            CHECK(volume.minimum == static_cast<double>(std::min(value, 7.0F)));
            CHECK(volume.maximum == static_cast<double>(std::max(value, 7.0F)));
        }
    };
    check(0, -3.0F);
    check(999'999, 70'000.0F);
    std::vector<double> fine(values.begin(), values.end());
    std::mt19937 random(4);
    for (double& value : fine) value += 0.001 * static_cast<double>(random() % 1000);
    CHECK(std::holds_alternative<SparseArray<float>>(stored(size, fine, 10'000).voxels));
    // Noise, behind a mask.
    for (std::size_t n = 100'000; n < values.size(); ++n) values[n] = static_cast<float>(random() % 256);
    CHECK(std::holds_alternative<SparseArray<std::uint8_t>>(stored(size, values, 10'000).voxels));
}

TEST_CASE("a mask of fractions is kept as runs, from the first fraction on") {
    const glm::ivec3 size(97, 53, 31);
    const auto whole = values_in_runs(std::size_t{97} * 53 * 31, 40.0, 4, 6);
    std::vector<float> values(whole.begin(), whole.end());
    for (std::size_t n = 0; n < values.size(); ++n)
        values[n] = n < 50'000 ? std::min(values[n], 1.0F) : values[n] / 4.0F;
    volume::Volume plain;
    SparseArray<float> array;
    array.resize(values.size());
    std::ranges::copy(values, array.begin());
    Job job;
    const JobRange all(job, 0.0F, 1.0F);
    for (const std::size_t at_once : {std::size_t{1000}, values.size()}) {
        const volume::Volume mask = stored(size, values, at_once);
        REQUIRE(std::holds_alternative<volume::FractionRuns>(mask.voxels));
        CHECK_FALSE(volume::holds_whole_numbers(mask));
        CHECK((mask.minimum == 0.0 && mask.maximum == 1.0));
        plain = mask;
        plain.voxels = array;
        bool same = true;
        for (std::size_t n = 0; n < values.size(); ++n)
            same = same && std::get<volume::FractionRuns>(mask.voxels)[n] == values[n];
        CHECK(same);
        CHECK(volume::label_counts(mask).empty());
        CHECK(volume::count_from(mask, 0.5) == volume::count_from(plain, 0.5));
        for (const volume::Selection& selection : {volume::Selection(), volume::Selection{{}, 0.75}}) {
            CHECK(volume::inside(mask, selection, all)->count() == volume::inside(plain, selection, all)->count());
            const auto surface = volume::isosurface(mask, selection, {}, job);
            REQUIRE(surface);
            CHECK(surface == *volume::isosurface(plain, selection, {}, job));
        }
        CHECK_FALSE(volume::inside(mask, {{1}, std::nullopt}, all));
    }
}

TEST_CASE("a mask takes less memory than a bit for each of its voxels, and a volume that does not fit is refused") {
    const glm::ivec3 size(2048, 2048, 64);
    const double voxels = 2048.0 * 2048 * 64;
    const double before = process_memory();
    volume::VoxelStore store(size, {voxels / 8}, "test");
    std::vector<std::uint8_t> slice(std::size_t{2048} * 2048, 0);
    for (std::size_t n = 0; n < slice.size(); ++n)
        if (n % 2048 > 900 && n % 2048 < 1000) slice[n] = static_cast<std::uint8_t>(1 + n / 2048 % 3);
    for (int k = 0; k < size.z; ++k) REQUIRE(store.append(slice.data(), slice.size(), {}));
    volume::Volume volume;
    std::move(store).finish(volume);
    CHECK(process_memory() - before - static_cast<double>(slice.size()) < voxels / 8);

    volume::VoxelStore scan(size, {voxels / 2}, "scan.nii");
    std::mt19937 random(5);
    for (std::uint8_t& value : slice) value = static_cast<std::uint8_t>(random());
    const auto refused = scan.append(slice.data(), slice.size(), {});
    REQUIRE_FALSE(refused);
    CHECK(refused.error().what.find("MB of memory; 134 MB are left to it") != std::string::npos);
    CHECK(refused.error().where == "scan.nii");

    volume::VoxelStore compared(size, {voxels / 8, 256.0}, "scan.nii");
    for (int k = 0; k < size.z; ++k) REQUIRE(compared.append(slice.data(), slice.size(), {1.0, k == 7 ? 1.0 : 0.0}));
    volume::Volume mask;
    std::move(compared).finish(mask);
    CHECK(volume::count_from(mask, 1.0) == static_cast<std::uint64_t>(std::ranges::count(slice, 255)));
}

TEST_CASE("of a scan that is read with a threshold, what is at least as much is 1") {
    constexpr double kNan = std::numeric_limits<double>::quiet_NaN(), kMost = std::numeric_limits<double>::infinity();
    const glm::ivec3 size(5, 1, 1);
    const auto read = [&](const auto& raw, double threshold, const volume::Scaling& scaling) -> Result<volume::Volume> {
        volume::VoxelStore store(size, {1e9, threshold}, "scan.nii");
        if (auto kept = store.append(raw.data(), raw.size(), scaling); !kept) return tl::unexpected(kept.error());
        if (auto settled = store.settle_nan(); !settled) return tl::unexpected(settled.error());
        volume::Volume volume;
        std::move(store).finish(volume);
        return volume;
    };
    const auto inside = [&](const auto& raw, double threshold, const volume::Scaling& scaling = {}) {
        const auto volume = read(raw, threshold, scaling);
        REQUIRE(volume);
        CHECK(volume->threshold == threshold);
        std::string bits;
        for (int x = 0; x < size.x; ++x) bits += volume::value_at(*volume, {x, 0, 0}) == 1.0 ? '1' : '0';
        Job job;
        const auto mask = volume::inside(*volume, {{}, threshold}, JobRange(job, 0.0F, 1.0F));
        CHECK((mask ? mask->count() : 0) == static_cast<std::uint64_t>(std::ranges::count(bits, '1')));
        return bits;
    };
    CHECK(inside(std::array<std::int16_t, 5>{-1000, 40, 41, 39, 3000}, 40.0) == "01101");
    CHECK(inside(std::array<std::int16_t, 5>{-1000, 40, 41, 39, 3000}, -1000.0) == "11111");
    CHECK(inside(std::array<std::int16_t, 5>{-1000, 40, 41, 39, 3000}, 1001.0, {-1.0, 1.0}) == "10000");
    // Values that would lose digits, or have no place, in what a volume holds.
    CHECK(inside(std::array<double, 5>{1e300, 0.1, 0.1 + 1e-12, -1e300, 0.0}, 0.1 + 1e-13) == "10100");
    CHECK(inside(std::array<std::uint64_t, 5>{1ULL << 60, 3, 1ULL << 33, 0, 7}, 7.0) == "10101");
    // NaN is outside, below and above 0.
    CHECK(inside(std::array<double, 5>{kNan, -5.0, kNan, 0.0, 2.0}, -5.0) == "01011");
    const auto notes = read(std::array<double, 5>{kNan, -5.0, kNan, 0.0, 2.0}, 0.0, {})->notes;
    REQUIRE(notes.size() == 1);
    CHECK(notes[0].starts_with("2 voxels are NaN"));
    CHECK_FALSE(read(std::array<double, 5>{kNan, kNan, kNan, kNan, kNan}, 0.0, {}));
    const auto refused = read(std::array<double, 5>{0.0, 1.0, kMost, 0.0, 0.0}, 0.5, {});
    REQUIRE_FALSE(refused);
    CHECK(refused.error().what == "the value of voxel (2, 0, 0) is not finite");
}
