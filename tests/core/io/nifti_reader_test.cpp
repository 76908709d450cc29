// NIfTI as the standard has it: every type, byte order, version and way to say where voxels lie; and what is refused.
#include "core/io/volumes/volume_file.h"
#include "core/volume/label_counts.h"
#include "tests/support/nifti_file.h"
#include "tests/support/volume_files.h"

#include <cmath>
#include <doctest/doctest.h>
#include <glm/geometric.hpp>
#include <limits>
#include <random>

using namespace ramus;
using test::holds;
using test::NiftiFile;
using test::NiftiType;

namespace {

NiftiFile two_by_three_by_four() {
    NiftiFile file;
    file.dim = {3, 2, 3, 4, 1, 1, 1, 1};
    std::vector<std::uint8_t> values(24);
    for (std::size_t n = 0; n < values.size(); ++n) values[n] = static_cast<std::uint8_t>(n);
    file.put(values);
    return file;
}

template <class T> void check_type(NiftiType type, const std::vector<T>& values) {
    const test::VolumeFiles files{"a.nii"};
    for (const int version : {1, 2}) {
        for (const bool big_endian : {false, true}) {
            CAPTURE(static_cast<int>(type));
            CAPTURE(version);
            CAPTURE(big_endian);
            NiftiFile file;
            file.version = version;
            file.big_endian = big_endian;
            file.type = static_cast<int>(type);
            file.dim = {3, static_cast<std::int64_t>(values.size()), 1, 1, 1, 1, 1, 1};
            file.put(values);
            const volume::Volume volume = files.good(file.bytes());
            REQUIRE(volume::voxel_count(volume.size) == values.size());
            for (std::size_t n = 0; n < values.size(); ++n)
                CHECK(volume::value_at(volume, {static_cast<int>(n), 0, 0}) == static_cast<double>(values[n]));
            CHECK(volume.minimum == static_cast<double>(*std::ranges::min_element(values)));
            CHECK(volume.maximum == static_cast<double>(*std::ranges::max_element(values)));
        }
    }
}

template <class T> bool kept_as(const volume::Volume& volume) {
    return std::holds_alternative<SparseArray<T>>(volume.voxels);
}

} // namespace

TEST_CASE("NIfTI values of every type, version and byte order are read as they are") {
    check_type<std::uint8_t>(NiftiType::kUint8, {0, 1, 200, 255});
    check_type<std::int8_t>(NiftiType::kInt8, {0, -128, 127, 5});
    check_type<std::uint16_t>(NiftiType::kUint16, {0, 1, 65535, 300});
    check_type<std::int16_t>(NiftiType::kInt16, {0, -1024, 3071, 1});
    check_type<std::uint32_t>(NiftiType::kUint32, {0, 1, 2147483647, 70000});
    check_type<std::int32_t>(NiftiType::kInt32, {0, -2147483647 - 1, 2147483647, 70000});
    check_type<std::uint64_t>(NiftiType::kUint64, {0, 1, 2147483647, 70000});
    check_type<std::int64_t>(NiftiType::kInt64, {0, -70000, 2147483647, 1});
    check_type<float>(NiftiType::kFloat32, {0.0F, 0.25F, -3.5F, 1e30F});
    check_type<double>(NiftiType::kFloat64, {0.0, 0.25, -3.5, 1e6});
}

TEST_CASE("values are kept in the smallest type that holds them, whatever the file's is") {
    const test::VolumeFiles files{"a.nii"};
    const auto of = [&](const std::vector<double>& values) {
        NiftiFile file;
        file.type = static_cast<int>(NiftiType::kFloat64);
        file.dim = {1, static_cast<std::int64_t>(values.size()), 1, 1, 1, 1, 1, 1};
        file.put(values);
        return files.good(file.bytes());
    };
    CHECK(kept_as<std::uint8_t>(of({0, 1, 255})));
    CHECK(kept_as<std::uint16_t>(of({0, 1, 256})));
    CHECK(kept_as<std::int16_t>(of({-1, 1, 256})));
    CHECK(kept_as<std::int32_t>(of({-1, 1, 65535})));
    CHECK(kept_as<float>(of({0, 0.5, 1})));
    CHECK(kept_as<float>(of({0, 3e9})));

    // What does not fit any more comes late, after megabytes of what did.
    std::vector<std::int16_t> values(3'000'000, 7);
    values[1'500'000] = 1000;
    values[2'500'000] = -3;
    NiftiFile file;
    file.type = static_cast<int>(NiftiType::kInt16);
    file.dim = {3, 300, 100, 100, 1, 1, 1, 1};
    file.put(values);
    const volume::Volume volume = files.good(file.bytes());
    CHECK(kept_as<std::int16_t>(volume));
    const auto counts = volume::label_counts(volume);
    CHECK(counts == std::vector<volume::LabelCount>{{-3, 1}, {7, 2'999'998}, {1000, 1}});
}

TEST_CASE("voxels run along the first axis first, compressed or not, and behind extensions") {
    const test::VolumeFiles files{"a.nii"};
    NiftiFile file = two_by_three_by_four();
    const auto check = [](const Result<volume::Volume>& volume) {
        REQUIRE(volume);
        CHECK(volume->size == glm::ivec3(2, 3, 4));
        CHECK(volume::value_at(*volume, {1, 2, 3}) == 23.0);
        CHECK(volume::value_at(*volume, {1, 0, 1}) == 7.0);
    };
    Job job;
    check(files.read(file.bytes()));
    check(io::read_volume(test::write_gzip(files.folder.path() / "a.nii.gz", file.bytes()), {}, job));
    check(io::read_volume(test::write_gzip(files.folder.path() / "b.nii", file.bytes()), {}, job)); // by its content
    file.offset = 4096;
    check(files.read(file.bytes()));
    file.version = 2;
    check(files.read(file.bytes()));
}

TEST_CASE("where voxels lie: sform before qform before voxel sizes, in mm") {
    const test::VolumeFiles files{"a.nii"};
    NiftiFile file = two_by_three_by_four();
    const auto place = [&](const glm::dvec3& voxel) {
        return glm::dvec3(files.good(file.bytes()).to_patient * glm::dvec4(voxel, 1.0));
    };
    file.pixdim = {1, 2, 3, 4, 1, 1, 1, 1};
    file.rows = {-0.5, 0, 0, 10, 0, 0.25, 0, 20, 0, 0, 8, -30};
    file.qform = 1;
    file.quaternion = {0, 0, std::sqrt(0.5)}; // a quarter turn about z: x leads to y
    file.origin = {7, 8, 9};

    CHECK(place({2, 4, 1}) == glm::dvec3(9, 21, -22));
    CHECK(volume::orientation(files.good(file.bytes()).to_patient) == "LAS");
    CHECK(volume::mirrors(files.good(file.bytes()).to_patient));

    file.sform = 0;
    // (1, 0, 0) is 2 mm along y; (0, 1, 0) 3 mm along -x; single precision.
    CHECK(glm::distance(place({1, 0, 0}), {7, 10, 9}) < 1e-6);
    CHECK(glm::distance(place({0, 1, 0}), {4, 8, 9}) < 1e-6);
    CHECK(glm::distance(place({0, 0, 1}), {7, 8, 13}) < 1e-6);
    CHECK(volume::orientation(files.good(file.bytes()).to_patient) == "ALS");
    file.pixdim[0] = -1; // qfac: the third axis the other way
    CHECK(glm::distance(place({0, 0, 1}), {7, 8, 5}) < 1e-6);

    file.qform = 0;
    CHECK(place({1, 1, 1}) == glm::dvec3(2, 3, 4));
    CHECK(files.good(file.bytes()).notes.size() == 1);

    file.units = 1; // m
    CHECK(place({1, 1, 1}) == glm::dvec3(2000, 3000, 4000));
    file.units = 3; // micron
    CHECK(glm::distance(place({1, 1, 1}), {0.002, 0.003, 0.004}) < 1e-15);
    file.units = 2 + 8; // mm and seconds
    CHECK(place({1, 1, 1}) == glm::dvec3(2, 3, 4));
    file.units = 0;
    CHECK(place({1, 1, 1}) == glm::dvec3(2, 3, 4));
    CHECK(files.good(file.bytes()).notes.size() == 2);

    file.version = 2; // doubles, exactly
    file.pixdim = {1, 0.1, 0.2, 0.3, 1, 1, 1, 1};
    CHECK(place({1, 1, 1}) == glm::dvec3(0.1, 0.2, 0.3));
}

TEST_CASE("values are scaled as the header says, and not by a slope of 0") {
    const test::VolumeFiles files{"a.nii"};
    NiftiFile file = two_by_three_by_four();
    const auto last = [&] { return volume::value_at(files.good(file.bytes()), {1, 2, 3}); };
    file.slope = 0.0, file.intercept = 5.0;
    CHECK(last() == 23.0);
    file.slope = 1.0;
    CHECK(last() == 28.0);
    file.slope = 0.5;
    CHECK(last() == 16.5);
    file.slope = -2.0;
    CHECK(last() == -41.0);
    file.slope = std::numeric_limits<double>::quiet_NaN();
    CHECK(last() == 23.0);
    file.slope = 1.0, file.intercept = std::numeric_limits<double>::infinity();
    CHECK(holds(files.refusal(file.bytes()), "intercept"));
}

TEST_CASE("one volume in four dimensions is read, more are refused") {
    const test::VolumeFiles files{"a.nii"};
    NiftiFile file = two_by_three_by_four();
    file.dim[0] = 5;
    CHECK(files.good(file.bytes()).size == glm::ivec3(2, 3, 4));
    file.dim = {4, 2, 3, 2, 2, 1, 1, 1};
    CHECK(holds(files.refusal(file.bytes()), "holds 2 volumes"));
    file.dim = {2, 6, 4, 9, 9, 9, 9, 9}; // beyond the second, nothing counts
    CHECK(files.good(file.bytes()).size == glm::ivec3(6, 4, 1));
}

TEST_CASE("headers that make no sense are refused with a word") {
    const test::VolumeFiles files{"a.nii"};
    const auto with = [&](auto change) {
        NiftiFile file = two_by_three_by_four();
        change(file);
        return files.refusal(file.bytes());
    };
    constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
    CHECK(holds(with([](auto& f) { f.type = 128; }), "colours"));
    CHECK(holds(with([](auto& f) { f.type = 32; }), "complex"));
    CHECK(holds(with([](auto& f) { f.type = 1536; }), "128 bits"));
    CHECK(holds(with([](auto& f) { f.type = 1; }), "single bits"));
    CHECK(holds(with([](auto& f) { f.type = 77; }), "unknown type 77"));
    CHECK(holds(with([](auto& f) { f.magic = "ni1"; }), "pair"));
    CHECK(holds(with([](auto& f) { f.magic = "abc"; }), "ANALYZE"));
    CHECK(holds(with([](auto& f) { f.dim[2] = 0; }), "axis 2 is 0"));
    CHECK(holds(with([](auto& f) { f.dim[3] = -4; }), "axis 3 is -4"));
    CHECK(holds(with([](auto& f) { f.dim[0] = 0; }), "0 dimensions"));
    CHECK(holds(with([](auto& f) { f.dim[0] = 8; }), "8 dimensions"));
    CHECK(holds(with([](auto& f) { f.dim[1] = 3; }), "more than the file can hold"));
    CHECK(holds(with([](auto& f) { f.offset = 1e15; }), "more than the file can hold"));
    CHECK(holds(with([](auto& f) { f.offset = 1e30; }), "begin nowhere"));
    CHECK(holds(with([](auto& f) { f.rows = {}; }), "one plane"));
    CHECK(holds(with([](auto& f) { f.rows = {1, 0, 2, 0, 0, 1, 0, 0, 0, 0, 0, 0}; }), "one plane"));
    CHECK(holds(with([](auto& f) { f.rows[5] = kNaN; }), "no number"));
    CHECK(holds(with([](auto& f) { f.rows[3] = 1e30; }), "10 km"));
    CHECK(holds(with([](auto& f) { f.rows[3] = std::numeric_limits<double>::infinity(); }), "no number"));
    CHECK(holds(with([](auto& f) { f.sform = 0, f.qform = 1, f.quaternion = {3, 3, 3}; }), "no rotation"));
    CHECK(holds(with([](auto& f) { f.sform = 0, f.qform = 1, f.quaternion = {kNaN, 0, 0}; }), "no rotation"));
    CHECK(holds(with([](auto& f) { f.sform = 0, f.pixdim[2] = 0; }), "axis 2 is not a length"));
    CHECK(holds(with([](auto& f) { f.sform = 0, f.qform = 1, f.pixdim[1] = -1; }), "axis 1 is not a length"));
}

TEST_CASE("what cannot be read is refused with a word") {
    const test::VolumeFiles files{"a.nii"};
    CHECK(holds(files.refusal(""), "empty"));
    CHECK(holds(files.refusal("neither"), "no NIfTI"));
    CHECK(holds(files.refusal(std::string(100000, 'x')), "no NIfTI"));

    NiftiFile labels = two_by_three_by_four();
    labels.type = static_cast<int>(NiftiType::kUint32);
    labels.dim = {1, 2, 1, 1, 1, 1, 1, 1};
    labels.put(std::vector<std::uint32_t>{3'000'000'000U, 1}); // which gets the number of the other one
    CHECK(holds(files.refusal(labels.bytes()), "cannot all be kept exactly"));
    NiftiFile field = labels;
    field.type = static_cast<int>(NiftiType::kFloat32);
    field.put(std::vector<float>{1.0F, std::numeric_limits<float>::infinity()});
    CHECK(holds(files.refusal(field.bytes()), "voxel (1, 0, 0) is not finite"));
    field.put(std::vector<float>{-std::numeric_limits<float>::infinity(), 1.0F});
    CHECK(holds(files.refusal(field.bytes()), "voxel (0, 0, 0) is not finite"));
    field.type = static_cast<int>(NiftiType::kFloat64);
    field.put(std::vector<double>{0.5, 1e200});
    CHECK(holds(files.refusal(field.bytes()), "single precision"));

    Job job;
    const auto at = [&](const char* name, const std::string& bytes) {
        const auto volume = io::read_volume(test::write_plain(files.folder.path() / name, bytes), {}, job);
        REQUIRE_FALSE(volume);
        return volume.error().message();
    };
    CHECK(holds(at("a.nrrd", "some bytes"), "no NRRD file"));
    CHECK(holds(at("a.dat", "some bytes"), "no volume that can be read"));
    CHECK(holds(at("a.img", "some bytes"), "pair"));
    CHECK(holds(at("a.swc", "1 2 0 0 0 1 -1\n"), "vessel tree"));
    CHECK(holds(io::read_volume(files.folder.path(), {}, job).error().message(), "no DICOM image"));
    CHECK(holds(io::read_volume(files.folder.path() / "none.nii", {}, job).error().message(), "no such file"));
}

TEST_CASE("a small file that claims much is refused before memory is taken") {
    const test::VolumeFiles files{"a.nii"};
    NiftiFile file = two_by_three_by_four();
    file.version = 2;
    file.units = 3; // micron, or it would be too far away
    file.dim = {3, 2'000'000'000, 2'000'000'000, 2'000'000'000, 1, 1, 1, 1};
    CHECK(holds(files.refusal(file.bytes()), "more than the file can hold"));
    Job job;
    const auto compressed = [&](double memory) {
        const auto volume =
            io::read_volume(test::write_gzip(files.folder.path() / "a.nii.gz", file.bytes()), {memory}, job);
        REQUIRE_FALSE(volume);
        return volume.error().what;
    };
    CHECK(holds(compressed(0.0), "more than the file can hold"));
    // Within what compression could do: read until the file ends.
    file.dim = {3, 50, 50, 10, 1, 1, 1, 1};
    CHECK(holds(compressed(0.0), "ends before"));
    // Zeros by the megabyte do come out of a small file; then memory sets the limit.
    file.dim = {3, 256, 256, 255, 1, 1, 1, 1};
    file.data.assign(std::size_t{256} * 256 * 255, '\0');
    CHECK(holds(compressed(1.0), "take 2 MB of memory"));
    CHECK(io::read_volume(files.folder.path() / "a.nii.gz", {}, job));
}

TEST_CASE("a file that was cut short or damaged on its way is refused" * doctest::test_suite("slow")) {
    const test::VolumeFiles files{"a.nii"};
    Job job;
    NiftiFile file;
    file.dim = {3, 50, 40, 30, 1, 1, 1, 1};
    std::vector<std::uint8_t> values(60000);
    std::mt19937 random(7);
    for (auto& value : values) value = static_cast<std::uint8_t>(random());
    file.put(values);
    for (const int version : {1, 2}) {
        file.version = version;
        const std::string bytes = file.bytes();
        for (const std::size_t length : {1UL, 100UL, 347UL, 400UL, 543UL, 10000UL, bytes.size() - 1}) {
            CAPTURE(length);
            files.refusal(bytes.substr(0, length));
        }
        const auto path = test::write_gzip(files.folder.path() / "whole.nii.gz", bytes);
        REQUIRE(io::read_volume(path, {}, job));
        const std::string gzip = files.folder.text("whole.nii.gz");
        const auto read = [&](const std::string& text) {
            return io::read_volume(test::write_plain(files.folder.path() / "cut.nii.gz", text), {}, job);
        };
        for (const std::size_t length : {1UL, 5UL, 15UL, 100UL, 10000UL, gzip.size() - 9})
            CHECK_FALSE(read(gzip.substr(0, length)));
        for (int n = 0; n < 200; ++n) { // a checksum tells
            std::string damaged = gzip;
            const std::size_t at = 10 + random() % (gzip.size() - 18);
            damaged[at] = static_cast<char>(damaged[at] ^ (1 << random() % 8));
            CHECK_FALSE(read(damaged));
        }
    }
}

TEST_CASE("random damage to headers ends in a volume or in an error" * doctest::test_suite("slow")) {
    const test::VolumeFiles files{"a.nii"};
    std::mt19937 random(11);
    NiftiFile file = two_by_three_by_four();
    for (int n = 0; n < 3000; ++n) {
        file.version = 1 + n % 2;
        file.big_endian = n % 3 == 0;
        std::string bytes = file.bytes();
        for (unsigned hits = 1 + random() % 4; hits > 0; --hits)
            bytes[random() % (file.version == 2 ? 544 : 352)] = static_cast<char>(random());
        const auto volume = files.read(bytes, 1e9);
        if (!volume) CHECK_FALSE(volume.error().what.empty());
    }
}

TEST_CASE("reading can be cancelled") {
    const test::VolumeFiles files{"a.nii"};
    Job job;
    job.cancel();
    const auto volume =
        io::read_volume(test::write_plain(files.folder.path() / "a.nii", two_by_three_by_four().bytes()), {}, job);
    REQUIRE_FALSE(volume);
    CHECK(volume.error().what == "cancelled");
}
