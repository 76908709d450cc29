// What files say about the values of a scan: their unit, the modality, the window to display.
#include "tests/support/dicom_file.h"
#include "tests/support/volume_files.h"

#include <cmath>
#include <cstring>
#include <doctest/doctest.h>
#include <functional>

using namespace ramus;
using test::DicomElements;
using test::DicomSliceFile;

namespace {

volume::Volume series_with(const std::function<void(DicomElements&, int)>& change) {
    const TemporaryFolder folder;
    for (int n = 0; n < 5; ++n) {
        DicomSliceFile slice;
        slice.position = {0.0, 0.0, 2.0 * n};
        slice.number = n;
        DicomElements elements = slice.elements();
        change(elements, n);
        folder.write(std::to_string(n) + ".dcm", elements.file());
    }
    Job job;
    auto volume = io::read_volume(folder.path(), {}, job);
    REQUIRE_MESSAGE(volume, (volume ? "" : volume.error().message()));
    return std::move(*volume);
}

std::string unit_with(const std::function<void(DicomElements&)>& change) {
    return series_with([&](DicomElements& each, int) { change(each); }).value_unit;
}

// Offsets of cal_max and cal_min in nifti1.h and nifti2.h.
std::string with_cal(int version, double least, double most) {
    test::NiftiFile file;
    file.version = version;
    file.put(std::vector<std::uint8_t>{1});
    std::string bytes = file.bytes();
    const auto put = [&](std::size_t at, auto value) { std::memcpy(&bytes[at], &value, sizeof value); };
    if (version == 1)
        put(124, static_cast<float>(most)), put(128, static_cast<float>(least));
    else
        put(192, most), put(200, least);
    return bytes;
}

} // namespace

TEST_CASE("values of a DICOM series are in HU only where the standard or the file says so") {
    CHECK(unit_with([](DicomElements&) {}) == "HU"); // an original CT image, PS3.3 C.8.2.1
    CHECK(unit_with([](DicomElements& each) { each.text(0x00281054, "LO", "HU"); }) == "HU");
    CHECK(unit_with([](DicomElements& each) { each.text(0x00281054, "LO", "US"); }).empty());
    CHECK(unit_with([](DicomElements& each) { each.text(0x00281054, "LO", "Z_EFF"); }) == "Z_EFF");
    CHECK(unit_with([](DicomElements& each) { each.text(0x00281054, "LO", "a\033b"); }) == "a\\u001bb");
    CHECK(unit_with([](DicomElements& each) { each.text(0x00080008, "CS", "DERIVED\\PRIMARY\\AXIAL"); }).empty());
    CHECK(unit_with([](DicomElements& each) { each.text(0x00080008, "CS", "ORIGINAL\\PRIMARY\\LOCALIZER"); }).empty());
    CHECK(unit_with([](DicomElements& each) { each.text(0x00189361, "CS", "YES"); }).empty()); // multi-energy
    CHECK(unit_with([](DicomElements& each) { each.text(0x00080060, "CS", "MR"); }).empty());
    CHECK(unit_with([](DicomElements& each) { each.remove(0x00281052).remove(0x00281053); }).empty());
    const volume::Volume mixed = series_with([](DicomElements& each, int n) {
        if (n == 3) each.text(0x00281054, "LO", "US");
    });
    CHECK(mixed.value_unit.empty());
    CHECK(mixed.modality == "CT");
    CHECK(series_with([](DicomElements& each, int) { each.text(0x00080060, "CS", "MR"); }).modality == "MR");
}

TEST_CASE("the window of a DICOM series is the first one of its middle image") {
    const volume::Volume volume = series_with([](DicomElements& each, int n) {
        each.decimals(0x00281050, {40.0 + n, -600.0}).decimals(0x00281051, {400.0 + n, 1500.0});
    });
    CHECK(volume.window == volume::DisplayWindow{42.0, 402.0});
    for (const double width : {0.0, -400.0}) {
        const volume::Volume flat = series_with(
            [&](DicomElements& each, int) { each.decimals(0x00281050, {40.0}).decimals(0x00281051, {width}); });
        CHECK_FALSE(flat.window);
    }
    CHECK_FALSE(series_with([](DicomElements& each, int) { each.decimals(0x00281050, {40.0}); }).window);
}

TEST_CASE("unit and window of frames come from their groups") {
    DicomSliceFile slice;
    slice.values.resize(24);
    DicomElements file = slice.elements();
    file.number(0x00280010, 3).text(0x00280008, "IS", "2").text(0x00080008, "CS", "DERIVED\\PRIMARY\\AXIAL");
    file.remove(0x00200032).remove(0x00281052).remove(0x00281053);
    std::vector<DicomElements> each;
    for (int n = 0; n < 2; ++n) {
        DicomElements frame;
        frame.items(0x00209113, {DicomElements().decimals(0x00200032, {0, 0, 2.0 * n})});
        frame.items(
            0x00289145,
            {DicomElements().decimals(0x00281053, {1}).decimals(0x00281052, {-1024}).text(0x00281054, "LO", "HU")});
        frame.items(0x00289132, {DicomElements().decimals(0x00281050, {10.0 * n}).decimals(0x00281051, {100})});
        each.push_back(frame);
    }
    file.items(0x52009230, each).pixels(std::string(48, '\0'), 2);
    const test::VolumeFiles files{"a.dcm"};
    const volume::Volume volume = files.good(file.file());
    CHECK(volume.value_unit == "HU");
    CHECK(volume.window == volume::DisplayWindow{10.0, 100.0});
}

TEST_CASE("NIfTI proposes a window by cal_min and cal_max") {
    const test::VolumeFiles files{"a.nii"};
    for (const int version : {1, 2}) {
        CHECK(files.good(with_cal(version, -160.0, 240.0)).window == volume::DisplayWindow{40.0, 400.0});
        CHECK_FALSE(files.good(with_cal(version, 0.0, 0.0)).window);
        CHECK_FALSE(files.good(with_cal(version, 240.0, -160.0)).window);
        CHECK_FALSE(files.good(with_cal(version, 0.0, HUGE_VAL)).window);
        CHECK_FALSE(files.good(with_cal(version, NAN, 1.0)).window);
    }
    CHECK(files.good(with_cal(1, 0.0, 1.0)).value_unit.empty());
    CHECK(files.good(with_cal(1, 0.0, 1.0)).modality.empty());
}

TEST_CASE("NRRD states the unit of its values by sample units") {
    const test::VolumeFiles files{"a.nrrd"};
    const std::string header = "NRRD0004\ntype: uint8\ndimension: 3\nsizes: 1 1 1\nencoding: raw\n";
    CHECK(files.good(header + "sample units: HU\n\n\1").value_unit == "HU");
    CHECK(files.good(header + "\n\1").value_unit.empty());
}
