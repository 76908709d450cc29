// Region growing against a flood of one voxel at a time, and against regions that geometry gives.
#include "core/io/volumes/volume_file.h"
#include "core/volume/grow_region.h"
#include "tests/support/shared_data.h"

#include <cmath>
#include <deque>
#include <doctest/doctest.h>
#include <functional>
#include <glm/geometric.hpp>
#include <random>

using namespace ramus;
using volume::GrownRegion;
using volume::RegionGrowing;

namespace {

template <class T> volume::Volume volume_of(const glm::ivec3& size, const std::function<double(glm::ivec3)>& value) {
    volume::Volume scan;
    scan.size = size;
    SparseArray<T> values;
    values.resize(volume::voxel_count(size));
    std::size_t n = 0;
    for (int k = 0; k < size.z; ++k)
        for (int j = 0; j < size.y; ++j)
            for (int i = 0; i < size.x; ++i) values[n++] = static_cast<T>(value({i, j, k}));
    scan.voxels = std::move(values);
    return scan;
}

Result<GrownRegion> grow(const volume::Volume& scan, const RegionGrowing& growing) {
    Job job;
    return volume::grow_region(scan, growing, JobRange(job, 0.0F, 1.0F));
}

GrownRegion grown(const volume::Volume& scan, const RegionGrowing& growing) {
    auto region = grow(scan, growing);
    REQUIRE_MESSAGE(region, (region ? "" : region.error().message()));
    return std::move(*region);
}

// One voxel at a time, every step tested, in double precision.
std::vector<char> flood(const volume::Volume& scan, const RegionGrowing& growing) {
    const auto place = [&](const glm::ivec3& at) { return glm::dvec3(scan.to_patient * glm::dvec4(at, 1.0)); };
    const auto number = [&](const glm::ivec3& at) {
        return (static_cast<std::size_t>(at.z) * static_cast<std::size_t>(scan.size.y) +
                static_cast<std::size_t>(at.y)) *
                   static_cast<std::size_t>(scan.size.x) +
               static_cast<std::size_t>(at.x);
    };
    const auto is_open = [&](const glm::ivec3& at) {
        for (int axis = 0; axis < 3; ++axis) {
            if (at[axis] < 0 || at[axis] >= scan.size[axis]) return false;
            if (growing.box && (at[axis] < growing.box->first[axis] || at[axis] > growing.box->last[axis]))
                return false;
        }
        for (const auto& ball : growing.balls)
            if (glm::distance(place(at), ball.centre_mm) <= ball.radius_mm) return false;
        const double value = volume::value_at(scan, at);
        return value >= growing.low && value <= growing.high;
    };
    const auto is_cut = [&](const glm::ivec3& from, const glm::ivec3& to) {
        for (const auto& disc : growing.discs) {
            const double a = glm::dot(place(from) - disc.centre_mm, disc.normal);
            const double b = glm::dot(place(to) - disc.centre_mm, disc.normal);
            if ((a >= 0.0) == (b >= 0.0)) continue;
            const glm::dvec3 at = place(from) + a / (a - b) * (place(to) - place(from));
            if (glm::distance(at, disc.centre_mm) <= disc.radius_mm) return true;
        }
        return false;
    };
    std::vector<char> found(volume::voxel_count(scan.size), 0);
    std::deque<glm::ivec3> open;
    for (const glm::ivec3& seed : growing.seeds)
        if (is_open(seed)) found[number(seed)] = 1, open.push_back(seed);
    while (!open.empty()) {
        const glm::ivec3 at = open.front();
        open.pop_front();
        for (int axis = 0; axis < 3; ++axis)
            for (const int step : {-1, 1}) {
                glm::ivec3 next = at;
                next[axis] += step;
                if (is_open(next) && found[number(next)] == 0 && !is_cut(at, next))
                    found[number(next)] = 1, open.push_back(next);
            }
    }
    return found;
}

void check_against_flood(const volume::Volume& scan, const RegionGrowing& growing) {
    const std::vector<char> truth = flood(scan, growing);
    const auto count = static_cast<std::uint64_t>(std::ranges::count(truth, 1));
    const auto region = grow(scan, growing);
    REQUIRE(region.has_value() == (count > 0));
    if (!region) return;
    CHECK(region->count == count);
    CHECK(region->mask.count() == count);
    CHECK(volume::bit_mask_of(region->mask).count() == count);
    glm::ivec3 first = scan.size, last(-1);
    std::size_t wrong = 0, n = 0;
    bool border = false;
    for (int k = 0; k < scan.size.z; ++k)
        for (int j = 0; j < scan.size.y; ++j)
            for (int i = 0; i < scan.size.x; ++i, ++n) {
                const glm::ivec3 at(i, j, k);
                if (region->mask.test(at) != (truth[n] != 0)) ++wrong;
                if (truth[n] == 0) continue;
                first = glm::min(first, at), last = glm::max(last, at);
                for (int axis = 0; axis < 3; ++axis) border |= at[axis] == 0 || at[axis] == scan.size[axis] - 1;
            }
    CHECK(wrong == 0);
    CHECK(region->bounds.first == first);
    CHECK(region->bounds.last == last);
    CHECK(region->touches_border == border);
    CHECK_FALSE(region->stopped_at_limit);
}

// Random values, of which about 45 in 100 are in [0, 100], so that regions wind; balls and discs; axes that shear.
template <class T> void check_random(unsigned number) {
    CAPTURE(number);
    std::mt19937 random(number);
    std::uniform_real_distribution<double> share(0.0, 1.0);
    const glm::ivec3 size(20 + static_cast<int>(number * 17 % 150), 23, 19);
    const glm::dvec3 middle = 0.5 * glm::dvec3(size);
    volume::Volume scan = volume_of<T>(size, [&](const glm::ivec3& at) {
        const bool inside = share(random) < 0.45 || glm::distance(glm::dvec3(at), middle) < 5.0;
        return inside ? std::floor(101.0 * share(random)) : 101.0 + std::floor(100.0 * share(random));
    });
    scan.to_patient = glm::dmat4(0.7, 0.1, 0.0, 0.0, 0.0, -0.6, 0.2, 0.0, 0.3, 0.0, 1.5, 0.0, -20.0, 5.0, 7.0, 1.0);
    const auto place = [&] {
        const glm::dvec3 voxel(share(random) * size.x, share(random) * size.y, share(random) * size.z);
        return glm::dvec3(scan.to_patient * glm::dvec4(voxel, 1.0));
    };
    RegionGrowing growing{.seeds = {glm::ivec3(middle), {0, 0, 0}, {size.x - 1, 11, 9}}, .low = 0.0, .high = 100.0};
    if (number % 2 == 1)
        for (int n = 0; n < 3; ++n) growing.balls.push_back({place(), 3.0 * share(random)});
    if (number / 2 % 2 == 1)
        for (int n = 0; n < 6; ++n)
            growing.discs.push_back({place(),
                                     {share(random) - 0.5, share(random) - 0.5, share(random) - 0.5},
                                     n == 0 ? 1e6 : 12.0 * share(random)});
    if (number / 4 % 2 == 1) growing.box = {{3, 2, -5}, {size.x - 4, 40, 14}};
    check_against_flood(scan, growing);
}

} // namespace

TEST_CASE("a region is what a flood of single voxels finds, in every type of values") {
    for (unsigned number = 0; number < 16; ++number) {
        check_random<std::uint8_t>(number);
        check_random<std::uint16_t>(number + 100);
        check_random<std::int16_t>(number + 200);
        check_random<std::int32_t>(number + 300);
        check_random<float>(number + 400);
    }
    volume::Volume runs = volume_of<std::uint8_t>({70, 4, 3}, [](const glm::ivec3&) { return 0.0; });
    volume::VoxelRuns values;
    for (int row = 0; row < 12; ++row) values.add(1, 60), values.add(row == 5 ? 1 : 0, 10);
    runs.voxels = values;
    check_against_flood(runs, {.seeds = {{3, 3, 2}}, .low = 1.0, .high = 1.0});
    volume::FractionRuns fractions;
    for (int row = 0; row < 12; ++row) fractions.add(0.75F, 60), fractions.add(row == 5 ? 0.5F : 0.25F, 10);
    runs.voxels = fractions;
    check_against_flood(runs, {.seeds = {{3, 3, 2}}, .low = 0.5, .high = 1.0});
}

TEST_CASE("a disc cuts a vessel through, and another place of it does not matter") {
    // A cylinder of radius 6 mm along z, its axis through (16, 16): 0.5 mm voxels, 40 of them along z.
    volume::Volume scan = volume_of<std::int16_t>({65, 65, 40}, [](const glm::ivec3& at) {
        return glm::length(glm::dvec2(0.5 * at.x - 16.0, 0.5 * at.y - 16.0)) <= 6.0 ? 300.0 : 0.0;
    });
    scan.to_patient = glm::dmat4(0.5);
    scan.to_patient[3][3] = 1.0;
    const RegionGrowing whole{.seeds = {{32, 32, 0}}, .low = 200.0, .high = 400.0};
    const std::uint64_t slice = grown(scan, whole).count / 40;
    CHECK(grown(scan, whole).count == 40 * slice);
    RegionGrowing cut = whole;
    cut.discs = {{{16.0, 16.0, 5.2}, {0.0, 0.0, 1.0}, 6.5}}; // voxels 0 to 10 are below it
    CHECK(grown(scan, cut).count == 11 * slice);
    CHECK(grown(scan, cut).bounds.last.z == 10);
    cut.discs[0].normal = {0.0, 0.0, -30.0};
    CHECK(grown(scan, cut).count == 11 * slice);
    cut.discs[0].radius_mm = 5.5; // a gap at the wall is enough to pass
    CHECK(grown(scan, cut).count == 40 * slice);
    cut.discs[0].centre_mm.x = 40.0; // beside the vessel
    CHECK(grown(scan, cut).count == 40 * slice);
    cut = whole;
    cut.balls = {{{16.0, 16.0, 10.0}, 7.0}};
    CHECK(grown(scan, cut).bounds.last.z < 20);
    CHECK(grown(scan, cut).touches_border); // at z = 0
    cut.seeds = {{32, 32, 20}};             // in the ball
    CHECK_FALSE(grow(scan, cut));
    cut.seeds.push_back({32, 32, 0});
    CHECK(grown(scan, cut).unused == std::vector<glm::ivec3>{{32, 32, 20}});
}

TEST_CASE("a leak stops at the limit, near its seed, and says so") {
    const volume::Volume scan = volume_of<std::uint8_t>({100, 100, 100}, [](const glm::ivec3&) { return 7.0; });
    RegionGrowing growing{.seeds = {{50, 50, 50}}, .low = 7.0, .high = 7.0, .most_voxels = 100'000};
    GrownRegion region = grown(scan, growing);
    CHECK(region.stopped_at_limit);
    CHECK(region.count == 100'000);
    CHECK(region.mask.count() == 100'000);
    growing.most_voxels = 1'000'000; // exactly all
    region = grown(scan, growing);
    CHECK_FALSE(region.stopped_at_limit);
    CHECK(region.count == 1'000'000);
    CHECK(region.touches_border);
}

TEST_CASE("growing refuses what makes no region, and can be cancelled") {
    volume::Volume scan = volume_of<std::uint8_t>({4, 4, 4}, [](const glm::ivec3&) { return 7.0; });
    const auto refusal = [&](const RegionGrowing& growing) {
        const auto region = grow(scan, growing);
        return region ? "" : region.error().what;
    };
    CHECK(refusal({.seeds = {}, .low = 0.0, .high = 9.0}) == "there is no seed to grow from");
    CHECK(refusal({.seeds = {{4, 0, 0}}, .high = 9.0}).starts_with("a seed is not in the volume"));
    CHECK(refusal({.seeds = {{0, 0, 0}}, .low = 9.0, .high = 0.0}) == "the range of values is empty");
    CHECK(refusal({.seeds = {{0, 0, 0}}, .low = NAN, .high = 0.0}) == "the range of values is empty");
    CHECK(refusal({.seeds = {{0, 0, 0}}, .low = 8.0, .high = 9.0}).starts_with("no seed"));
    CHECK(refusal({.seeds = {{0, 0, 0}}, .high = 9.0, .box = volume::VoxelBox{{3, 3, 3}, {2, 2, 2}}})
              .starts_with("no seed"));
    Job job;
    job.cancel();
    const auto cancelled =
        volume::grow_region(scan, {.seeds = {{0, 0, 0}}, .low = 0.0, .high = 9.0}, JobRange(job, 0.0F, 1.0F));
    REQUIRE_FALSE(cancelled);
    CHECK(cancelled.error().what == "cancelled");
    scan.overlaps = {{7, {1, 2}}};
    CHECK(refusal({.seeds = {{0, 0, 0}}, .high = 9.0}).starts_with("its labels overlap"));
    CHECK_FALSE(volume::suggested_range(scan, {0, 0, 0}));
}

TEST_CASE("the suggested range is that of the seed's tissue, also next to a wall") {
    std::mt19937 random(3);
    std::normal_distribution<double> noise(0.0, 20.0);
    volume::Volume scan = volume_of<std::int16_t>(
        {60, 60, 60}, [&](const glm::ivec3& at) { return std::round((at.x < 30 ? 300.0 : -50.0) + noise(random)); });
    for (const int x : {10, 28}) { // 28: 2 of 5 layers of the neighbourhood belong to the other tissue
        double mean = 0.0, spread = 0.0;
        for (int n = 5; n < 55; ++n) {
            const auto range = volume::suggested_range(scan, {x, n, n});
            REQUIRE(range);
            mean += range->mean / 50.0, spread += range->spread / 50.0;
            CHECK(range->low <= volume::value_at(scan, {x, n, n}));
            CHECK(range->high >= volume::value_at(scan, {x, n, n}));
            CHECK(range->low > 100.0); // 350 apart: 17 standard deviations
        }
        // 50 neighbourhoods of 75 to 125 values: standard error of the mean of means below 0.4.
        CHECK(std::abs(mean - 300.0) < 1.6);
        CHECK(std::abs(spread - 20.0) < 1.6);
    }
    scan = volume_of<float>({5, 5, 5}, [](const glm::ivec3&) { return 4.25; });
    const auto flat = volume::suggested_range(scan, {0, 0, 0});
    REQUIRE(flat);
    CHECK(flat->low == 4.25);
    CHECK(flat->high == 4.25);
    // Thick slices: the neighbourhood stays within the slice.
    scan = volume_of<std::int16_t>({9, 9, 9}, [](const glm::ivec3& at) { return at.z * 100.0; });
    scan.to_patient[2][2] = 5.0;
    CHECK(volume::suggested_range(scan, {4, 4, 4})->spread == 0.0);
    CHECK_FALSE(volume::suggested_range(scan, {9, 0, 0}));
}

TEST_CASE("in a real CT a region is what a flood finds" * doctest::test_suite("slow")) {
    const auto path = test::shared_volume("aorta_dissection_ct.nii.gz");
    if (!path) return;
    Job job;
    const auto scan = io::read_volume(*path, {}, job);
    REQUIRE(scan);
    const RegionGrowing growing{.seeds = {{41, 73, 22}}, .low = 200.0, .high = 900.0};
    CHECK(grown(*scan, growing).count == 268'127); // scipy.ndimage.label, version 1.10.1
    check_against_flood(*scan, growing);
    RegionGrowing cut = growing;
    const auto place = [&](const glm::dvec3& at) { return glm::dvec3(scan->to_patient * glm::dvec4(at, 1.0)); };
    cut.discs = {{place({41.0, 73.0, 60.3}), {0.2, -0.1, 1.0}, 40.0}};
    cut.balls = {{place({60.0, 60.0, 30.0}), 20.0}};
    cut.box = volume::VoxelBox{{0, 10, 5}, {119, 125, 140}};
    check_against_flood(*scan, cut);
    CHECK(grown(*scan, cut).count < 268'127);
    CHECK(grown(*scan, {.seeds = growing.seeds, .low = 400.0, .high = 700.0}).count == 169'950);
}
