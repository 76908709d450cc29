// What thresholds make of a scan: voxels and pieces for all thresholds at once, held against counting at each.
#include "core/volume/bit_mask.h"
#include "core/volume/label_counts.h"
#include "core/volume/threshold.h"
#include "tests/support/voxel_topology.h"

#include <algorithm>
#include <doctest/doctest.h>
#include <random>
#include <utility>
#include <vector>

using namespace ramus;

namespace {

template <class T> volume::Volume scan_of(const glm::ivec3& size, const std::vector<T>& values) {
    volume::Volume scan;
    scan.size = size;
    SparseArray<T> array;
    array.assign(values.begin(), values.end());
    scan.voxels = std::move(array);
    const auto [least, most] = std::ranges::minmax(values);
    scan.minimum = static_cast<double>(least), scan.maximum = static_cast<double>(most);
    return scan;
}

volume::ThresholdCurve curve_of(const volume::Volume& scan) {
    Job job;
    auto curve = volume::threshold_curve(scan, JobRange(job, 0.0F, 1.0F));
    REQUIRE_MESSAGE(curve, (curve ? "" : curve.error().message()));
    return std::move(*curve);
}

std::uint64_t pieces_at(const volume::Volume& scan, double threshold) {
    Job job;
    const auto mask = volume::inside(scan, {{}, threshold}, JobRange(job, 0.0F, 1.0F));
    return mask ? static_cast<std::uint64_t>(test::voxel_topology(*mask).pieces) : 0;
}

} // namespace

TEST_CASE("at every threshold the curve has the voxels and the pieces that counting there gives") {
    std::mt19937 random(7);
    std::uniform_int_distribution<int> whole(-40, 60);
    std::vector<std::int16_t> values(7 * 6 * 5);
    for (std::int16_t& value : values) value = static_cast<std::int16_t>(whole(random));
    const volume::Volume scan = scan_of<std::int16_t>({7, 6, 5}, values);
    const volume::ThresholdCurve curve = curve_of(scan);
    CHECK(curve.step == 1);
    REQUIRE(curve.thresholds.front() == scan.minimum);
    REQUIRE(curve.thresholds.back() == scan.maximum);
    for (std::size_t b = 0; b < curve.thresholds.size(); ++b) {
        CAPTURE(curve.thresholds[b]);
        CHECK(curve.voxels[b] == volume::count_from(scan, curve.thresholds[b]));
        CHECK(curve.pieces[b] == pieces_at(scan, curve.thresholds[b]));
    }
}

TEST_CASE("fractions are counted as comparing with the threshold has them, also where dividing rounds") {
    std::mt19937 random(11);
    std::uniform_real_distribution<float> between(-3.0F, 1000.0F);
    std::vector<float> values(9 * 8 * 7);
    for (float& value : values) value = between(random);
    const volume::Volume scan = scan_of<float>({9, 8, 7}, values);
    const volume::ThresholdCurve curve = curve_of(scan);
    CHECK(curve.voxels.front() == values.size());
    for (std::size_t b = 0; b < curve.thresholds.size(); b += 97)
        CHECK(curve.voxels[b] == volume::count_from(scan, curve.thresholds[b]));
    CHECK(curve.at(curve.thresholds[1234]) == 1234);
    CHECK(curve.at(-1e9) == 0);
    CHECK(curve.at(1e9) == curve.thresholds.size() - 1);
}

// Two classes of values that do not meet: whatever parts them is as good, and Otsu's threshold lies between them.
TEST_CASE("Otsu's threshold parts what is dark from what is bright") {
    std::vector<std::int16_t> values(1000, 0);
    for (std::size_t n = 0; n < values.size(); ++n)
        values[n] = static_cast<std::int16_t>(n < 800 ? n % 20 : 200 + n % 20);
    const volume::ThresholdCurve curve = curve_of(scan_of<std::int16_t>({10, 10, 10}, values));
    CHECK(curve.thresholds[curve.otsu] > 19.0);
    CHECK(curve.thresholds[curve.otsu] <= 200.0);
    CHECK(curve.voxels[curve.otsu] == 200);
}

TEST_CASE("runs of equal values give what single values give") {
    std::vector<std::int16_t> values(12 * 4 * 3, 5);
    for (std::size_t n = 30; n < 60; ++n) values[n] = 900;
    for (std::size_t n = 100; n < 110; ++n) values[n] = 400;
    volume::Volume scan = scan_of<std::int16_t>({12, 4, 3}, values);
    const volume::ThresholdCurve apart = curve_of(scan);
    volume::VoxelRuns runs;
    for (const std::int16_t value : values) runs.add(static_cast<std::uint16_t>(value), 1);
    scan.voxels = std::move(runs);
    CHECK(curve_of(scan) == apart);
}

TEST_CASE("a large scan is looked at in steps, and says so") {
    const glm::ivec3 size(200, 200, 120); // 4.8 million voxels
    std::vector<std::int16_t> values(static_cast<std::size_t>(size.x) * 200 * 120, 0);
    const auto fill = [&](int from, int to) {
        for (int k = from; k < to; ++k)
            for (int j = from; j < to; ++j)
                for (int i = from; i < to; ++i)
                    values[static_cast<std::size_t>(i) +
                           200 * (static_cast<std::size_t>(j) + 200 * static_cast<std::size_t>(k))] = 500;
    };
    fill(10, 30);
    fill(60, 90);
    const volume::ThresholdCurve curve = curve_of(scan_of<std::int16_t>(size, values));
    CHECK(curve.step == 2);
    CHECK(curve.voxels[curve.otsu] == 20 * 20 * 20 + 30 * 30 * 30);
    CHECK(curve.pieces[curve.otsu] == 2);
}

TEST_CASE("where all values are equal there is nothing to part, and cancelling is heard") {
    Job job;
    const volume::Volume even = scan_of<std::int16_t>({2, 2, 2}, std::vector<std::int16_t>(8, 300));
    const auto none = volume::threshold_curve(even, JobRange(job, 0.0F, 1.0F));
    REQUIRE_FALSE(none);
    CHECK_FALSE(none.error().hint.empty());
    job.cancel();
    const volume::Volume scan = scan_of<std::int16_t>({2, 1, 1}, {1, 2});
    const auto cancelled = volume::threshold_curve(scan, JobRange(job, 0.0F, 1.0F));
    REQUIRE_FALSE(cancelled);
    CHECK(cancelled.error().what == "cancelled");
}
