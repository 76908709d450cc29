// Volumes of values that are written and read again, in every type and format.
#include "core/io/volumes/value_map_file.h"
#include "core/io/volumes/volume_unit.h"
#include "tests/support/volume_files.h"

#include <algorithm>
#include <doctest/doctest.h>
#include <limits>
#include <random>

using namespace ramus;

namespace {

const glm::dmat4 kOblique(0.5, 0.125, 0.0, 0.0, -0.25, 0.75, 0.0625, 0.0, 0.0, -0.125, -2.0, 0.0, 10.5, -20.25, 300.0,
                          1.0);
volume::Volume written_and_read(const io::ValueMap& map, const char* name) {
    const TemporaryFolder folder;
    Job job;
    const auto written = io::write_value_map(map, folder.path() / name, JobRange(job, 0.0F, 1.0F));
    REQUIRE_MESSAGE(written, (written ? "" : written.error().message()));
    auto volume = io::read_volume(folder.path() / name, {}, job);
    REQUIRE_MESSAGE(volume, (volume ? "" : volume.error().message()));
    return std::move(*volume);
}

template <class T> void check_written(const char* type) {
    const glm::ivec3 size(7, 5, 3);
    std::vector<T> values(volume::voxel_count(size));
    std::mt19937 random(11);
    for (T& value : values)
        value = std::is_integral_v<T> ? static_cast<T>(random()) : static_cast<T>(random()) / T(1024) - T(1000);
    values[4] = std::numeric_limits<T>::lowest(), values[104] = std::numeric_limits<T>::max();
    io::ValueMap map{.size = size, .to_patient = kOblique, .claims = {}, .fill_slice = {}};
    map.fill_slice = io::FillSlice<T>([&](int k, std::span<T> slice) {
        CHECK(std::ranges::all_of(slice, [](T value) { return value == T(0); }));
        std::copy_n(values.begin() + 35 * k, 35, slice.begin());
    });
    map.value_unit = "HU";
    map.window = {40.0, 400.0};
    for (const char* name : {"a.nii", "a.nii.gz", "a.nrrd"}) {
        CAPTURE(type);
        CAPTURE(name);
        const volume::Volume volume = written_and_read(map, name);
        REQUIRE(volume.size == size);
        for (int n = 0; n < 105; ++n)
            CHECK(volume::value_at(volume, {n % 7, n / 7 % 5, n / 35}) ==
                  static_cast<double>(values[static_cast<std::size_t>(n)]));
        CHECK(volume.to_patient == kOblique); // its numbers are exact in single precision
        CHECK(volume.unit_mm == 1.0);
        CHECK(volume::says_sides(volume));
        CHECK(volume.type.ends_with(type));
        const bool nrrd = std::string(name).ends_with("nrrd");
        CHECK(volume.value_unit == (nrrd ? "HU" : ""));
        CHECK(volume.window == (nrrd ? std::nullopt : std::optional(volume::DisplayWindow{40.0, 400.0})));
    }
}

} // namespace

TEST_CASE("values of every type are read as they were written") {
    check_written<std::uint8_t>("uint8");
    check_written<std::uint16_t>("uint16");
    check_written<std::int16_t>("int16");
    check_written<std::int32_t>("int32");
    check_written<float>("float32");
}

TEST_CASE("a volume that was read is written as it is, runs of values too") {
    const test::VolumeFiles files{"a.nii"};
    test::NiftiFile file;
    file.dim = {3, 100, 90, 80, 1, 1, 1, 1};
    std::vector<float> fractions(720'000, 0.0F);
    for (std::size_t n = 0; n < fractions.size(); n += 1000)
        std::fill_n(fractions.begin() + static_cast<int>(n), 300, 0.75F);
    std::vector<std::uint8_t> labels(720'000, 0);
    for (std::size_t n = 0; n < labels.size(); n += 900) std::fill_n(labels.begin() + static_cast<int>(n), 250, 3);
    std::vector<std::int16_t> scan(720'000);
    for (std::size_t n = 0; n < scan.size(); ++n) scan[n] = static_cast<std::int16_t>(n * 2654435761U >> 20U);
    const auto check = [&]<class T>(test::NiftiType type, const std::vector<T>& values, bool runs) {
        file.type = static_cast<int>(type);
        file.put(values);
        const volume::Volume first = files.good(file.bytes());
        CHECK((first.voxels.index() >= 5) == runs);
        const volume::Volume second =
            written_and_read(io::value_map(first, io::claims_of(first, std::nullopt)), "b.nii.gz");
        REQUIRE(second.size == first.size);
        std::size_t wrong = 0;
        for (int n = 0; n < 720'000; ++n) {
            const glm::ivec3 at(n % 100, n / 100 % 90, n / 9000);
            if (volume::value_at(second, at) != static_cast<double>(values[static_cast<std::size_t>(n)])) ++wrong;
        }
        CHECK(wrong == 0);
    };
    check(test::NiftiType::kFloat32, fractions, true);
    check(test::NiftiType::kUint8, labels, true);
    check(test::NiftiType::kInt16, scan, false);
}

TEST_CASE("a unit that nobody knows is not written, and what cannot be written is refused") {
    io::ValueMap map{
        .size = {2, 2, 2}, .to_patient = kOblique, .claims = {.unit = tree::SaidBy::kNobody}, .fill_slice = {}};
    map.fill_slice = io::FillSlice<float>([](int, std::span<float>) {});
    for (const char* name : {"a.nii", "a.nrrd"}) {
        const volume::Volume volume = written_and_read(map, name);
        CHECK_FALSE(volume.unit_mm);
        CHECK(volume.value_unit.empty());
        CHECK_FALSE(volume.window);
    }
    map.value_unit = "a\nb: c";
    CHECK(written_and_read(map, "a.nrrd").value_unit == "a b: c");
    const TemporaryFolder folder;
    Job job;
    const auto refusal = [&](const char* name) {
        const auto written = io::write_value_map(map, folder.path() / name, JobRange(job, 0.0F, 1.0F));
        return written ? "" : written.error().what;
    };
    CHECK(refusal("a.mha") == "a volume is not written in this format");
    job.cancel();
    CHECK(refusal("a.nii") == "cancelled");
    map.size.x = 32768;
    CHECK(refusal("a.nii") == "a side has more than 32,767 voxels");
    CHECK(folder.names().empty());
}
