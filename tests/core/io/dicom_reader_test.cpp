// DICOM series as scanners write them, and as they come from archives: in every transfer syntax, out of order, tilted,
// uneven, incomplete, damaged.
#include "core/io/trees/tree_file.h"
#include "core/io/volumes/dicom/dicom_reader.h"
#include "core/io/volumes/volume_file.h"
#include "tests/support/dicom_file.h"
#include "tests/support/volume_files.h"

#include <cmath>
#include <doctest/doctest.h>
#include <gdcmImageChangeTransferSyntax.h>
#include <gdcmImageReader.h>
#include <gdcmImageWriter.h>
#include <glm/geometric.hpp>
#include <random>

using namespace ramus;
using test::DicomElements;
using test::DicomLengths;
using test::DicomSliceFile;
using test::DicomSyntax;
using test::holds;

namespace {

// A folder of slices whose pixels are numbered through all of them.
struct SeriesFolder {
    TemporaryFolder folder = {};

    static DicomSliceFile slice(int n) {
        DicomSliceFile file;
        file.position = {10.0, 20.0, 2.5 * n};
        file.spacing = {0.5, 0.75};
        file.number = n;
        for (int pixel = 0; pixel < 12; ++pixel) file.values.push_back(static_cast<std::int16_t>(12 * n + pixel));
        return file;
    }
    void put(int n, const DicomElements& elements, DicomSyntax syntax = DicomSyntax::kExplicit,
             DicomLengths lengths = DicomLengths::kKnown) const {
        // Names that say nothing of the order.
        folder.write(std::to_string(n * 7 % 10) + ".dcm", elements.file(syntax, lengths));
    }
    void put_all(int count) const {
        for (int n = 0; n < count; ++n) put(n, slice(n).elements());
    }
    [[nodiscard]] Result<volume::Volume> read(const char* name = "", double memory = 0.0) const {
        Job job;
        return io::read_volume(folder.path() / name, {memory}, job);
    }
    [[nodiscard]] volume::Volume good(const char* name = "") const {
        auto volume = read(name);
        REQUIRE_MESSAGE(volume, (volume ? "" : volume.error().message()));
        return std::move(*volume);
    }
    [[nodiscard]] std::string refusal() const {
        const auto volume = read();
        REQUIRE_FALSE(volume);
        CHECK_FALSE(volume.error().where.empty());
        CHECK_FALSE(volume.error().hint.empty());
        return volume.error().what;
    }
};

void check_numbered(const volume::Volume& volume, int slices) {
    REQUIRE(volume.size == glm::ivec3(4, 3, slices));
    for (int z = 0; z < slices; ++z)
        for (int y = 0; y < 3; ++y)
            for (int x = 0; x < 4; ++x)
                CHECK(volume::value_at(volume, {x, y, z}) == 12 * z + 4 * y + x - 1024); // the intercept
}

Result<volume::Volume> from_memory(const std::string& bytes, double memory = 0.0) {
    Job job;
    auto source = io::ByteSource::of_memory(bytes, "memory.dcm");
    if (!source) return tl::unexpected(source.error());
    return io::read_dicom(*source, {memory}, job);
}

// The file, its pixels compressed by another program's code.
bool compress(const std::filesystem::path& file, gdcm::TransferSyntax::TSType type) {
    gdcm::ImageReader reader;
    reader.SetFileName(file.c_str());
    if (!reader.Read()) return false;
    gdcm::ImageChangeTransferSyntax change;
    change.SetTransferSyntax(type);
    change.SetInput(reader.GetImage());
    if (!change.Change()) return false;
    gdcm::ImageWriter writer;
    writer.SetFile(reader.GetFile());
    writer.SetImage(change.GetOutput());
    writer.SetFileName(file.c_str());
    return writer.Write();
}

} // namespace

TEST_CASE("a DICOM series is one volume, by its folder or any of its files, in every syntax") {
    for (const DicomSyntax syntax : {DicomSyntax::kExplicit, DicomSyntax::kImplicit, DicomSyntax::kBigEndian}) {
        for (const DicomLengths lengths : {DicomLengths::kKnown, DicomLengths::kOpen}) {
            const SeriesFolder series;
            for (int n = 0; n < 5; ++n) {
                DicomElements elements = SeriesFolder::slice(n).elements();
                // An icon with pixels of its own, in a sequence ahead of those that count.
                elements.items(0x00880200, {DicomElements().number(0x00280010, 2).pixels("abcd", 1)});
                series.put(n, elements, syntax, lengths);
            }
            series.folder.write("notes.txt", "no image");
            for (const char* name : {"", "0.dcm", "4.dcm"}) {
                const volume::Volume volume = series.good(name);
                check_numbered(volume, 5);
                CHECK(volume.type == "DICOM CT, int16");
                CHECK(volume.notes.empty());
                // LPS to RAS; columns are 0.5 mm apart, rows 0.75.
                CHECK(test::place(volume, {0, 0, 0}) == glm::dvec3(-10, -20, 0));
                CHECK(test::place(volume, {1, 2, 4}) == glm::dvec3(-10.5, -21.5, 10));
            }
        }
    }
    const SeriesFolder series;
    series.put_all(2);
    std::filesystem::rename(series.folder.path() / "0.dcm", series.folder.path() / "1.2.840.1");
    std::filesystem::rename(series.folder.path() / "7.dcm", series.folder.path() / "IM7");
    check_numbered(series.good("1.2.840.1"), 2);
    CHECK(io::is_volume(series.folder.path()));
    CHECK(io::is_volume(series.folder.path() / "IM7"));
    CHECK_FALSE(io::is_volume(series.folder.path().parent_path() / "none"));
    const TemporaryFolder empty;
    CHECK_FALSE(io::is_volume(empty.path()));
    CHECK(holds(io::read_tree(series.folder.path()).error().what, "volume"));
    CHECK(holds(io::read_tree(series.folder.path() / "IM7").error().what, "volume"));
}

TEST_CASE("oblique slices of a tilted gantry lie where their positions say") {
    const SeriesFolder series;
    const double tilt = std::atan2(1.5, 2.5);
    for (int n = 0; n < 4; ++n) {
        DicomSliceFile slice = SeriesFolder::slice(n);
        slice.position = {1.0, 2.0 + 1.5 * n, 2.5 * n};
        series.put(n, slice.elements());
    }
    volume::Volume volume = series.good();
    check_numbered(volume, 4);
    CHECK(test::place(volume, {2, 0, 3}) == glm::dvec3(-2, -6.5, 7.5));
    REQUIRE(volume.notes.size() == 1);
    CHECK(holds(volume.notes[0], "tilted by 31 degrees")); // atan(1.5 / 2.5)
    CHECK(tilt * 180.0 / 3.14159265358979 == doctest::Approx(30.96).epsilon(1e-3));

    // Sagittal: rows lead to the back, columns down; the normal leads to the left of the patient.
    for (int n = 0; n < 4; ++n) {
        DicomSliceFile slice = SeriesFolder::slice(n);
        slice.directions = {0, 1, 0, 0, 0, -1};
        slice.position = {-2.0 * n, 5, 6};
        series.put(n, slice.elements());
    }
    volume = series.good();
    CHECK(volume.notes.empty());
    CHECK(volume::orientation(volume.to_patient) == "PIR"); // y x -z = -x in LPS: right
    CHECK(test::place(volume, {0, 0, 3}) == glm::dvec3(6, -5, 6));
    CHECK(test::place(volume, {1, 2, 0}) == glm::dvec3(0, -5.5, 4.5));
    CHECK(volume::value_at(volume, {0, 0, 3}) == 36 - 1024);
}

TEST_CASE("uneven steps are said, missing slices and two at one place refused") {
    const auto with = [](int changed, double z) {
        const SeriesFolder series;
        for (int n = 0; n < 6; ++n) {
            DicomSliceFile slice = SeriesFolder::slice(n);
            if (n == changed) slice.position.z = z;
            series.put(n, slice.elements());
        }
        return series.read();
    };
    CHECK(with(3, 7.5001)->notes.empty());
    CHECK(holds(with(3, 7.8)->notes.at(0), "2.2 mm to 2.8 mm; put 2.5 mm apart, they are up to 0.3 mm"));
    CHECK(holds(with(3, 8.4).error().what, "even steps"));
    CHECK(holds(with(5, 15.0).error().what, "slices are missing"));
    CHECK(holds(with(3, 5.0).error().what, "lie at one place"));
    CHECK(holds(with(3, 5.0).error().hint, "a folder of their own"));
    CHECK(holds(with(3, NAN).error().what, "no number"));

    const SeriesFolder gap;
    for (const int n : {0, 1, 3, 4}) gap.put(n, SeriesFolder::slice(n).elements());
    CHECK(holds(gap.refusal(), "it is 5 mm, where 2.5 mm are the rule"));
    const SeriesFolder one;
    one.put(0, SeriesFolder::slice(0).elements().text(0x00180050, "DS", "3"));
    CHECK(test::place(one.good(), {0, 0, 1}).z == 3.0);
    CHECK(holds(one.good().notes.at(0), "3 mm thick"));
}

TEST_CASE("images of a series that lie otherwise are left out with a word, and other series named") {
    const SeriesFolder series;
    series.put_all(5);
    DicomElements localizer = SeriesFolder::slice(0).elements();
    localizer.text(0x00080008, "CS", "ORIGINAL\\PRIMARY\\LOCALIZER");
    series.folder.write("localizer", localizer.file());
    DicomSliceFile coronal = SeriesFolder::slice(1);
    coronal.directions = {1, 0, 0, 0, 0, -1};
    series.folder.write("coronal", coronal.elements().file());
    check_numbered(series.good(), 5);
    CHECK(holds(series.good().notes.at(0), "left out: 2 of its 7 images"));

    for (int n = 0; n < 2; ++n) {
        DicomSliceFile other = SeriesFolder::slice(n);
        other.series = "1.2.9";
        series.folder.write("other" + std::to_string(n),
                            other.elements().text(0x00200011, "IS", "7").text(0x0008103e, "LO", "Bone").file());
    }
    DicomElements report;
    report.text(0x00080016, "UI", "1.2.840.10008.5.1.4.1.1.88.11").text(0x00080018, "UI", "1.2.8");
    series.folder.write("report", report.file());
    const volume::Volume volume = series.good();
    check_numbered(volume, 5);
    REQUIRE(volume.notes.size() == 2);
    CHECK(holds(volume.notes[1], "read number 4, \"Thorax\", CT (7)"));
    CHECK(holds(volume.notes[1], "number 7, \"Bone\", CT (2)"));
    CHECK(series.good("other1").size.z == 2);
    CHECK(holds(series.read("report").error().what, "without an image"));
}

TEST_CASE("of the bits of a pixel those that are stored count, with their sign") {
    const auto read = [](int allocated, int stored, bool is_signed, const std::string& pixels) {
        DicomElements elements = SeriesFolder::slice(0).elements();
        elements.number(0x00280010, 1).number(0x00280011, 2).number(0x00280103, is_signed ? 1 : 0);
        elements.number(0x00280100, static_cast<std::uint16_t>(allocated));
        elements.number(0x00280101, static_cast<std::uint16_t>(stored));
        elements.number(0x00280102, static_cast<std::uint16_t>(stored - 1));
        elements.remove(0x00281052).remove(0x00281053).pixels(pixels, allocated / 8);
        return from_memory(elements.file());
    };
    const auto values = [](const Result<volume::Volume>& volume) {
        REQUIRE(volume);
        return glm::dvec2(volume::value_at(*volume, {0, 0, 0}), volume::value_at(*volume, {1, 0, 0}));
    };
    const std::string pixels = test::bytes_of(std::vector<std::uint16_t>{0xf801, 0x17ff}); // rubbish above bit 11
    CHECK(values(read(16, 12, false, pixels)) == glm::dvec2(0x801, 0x7ff));
    CHECK(values(read(16, 12, true, pixels)) == glm::dvec2(-2047, 0x7ff));
    CHECK(values(read(16, 16, false, pixels)) == glm::dvec2(0xf801, 0x17ff));
    CHECK(values(read(8, 8, false, "\xff\x01")) == glm::dvec2(255, 1));
    CHECK(values(read(8, 8, true, "\xff\x01")) == glm::dvec2(-1, 1));
    CHECK(values(read(32, 32, true, test::bytes_of(std::vector<std::int32_t>{-70000, 70000}))) ==
          glm::dvec2(-70000, 70000));
    CHECK(holds(read(16, 17, false, pixels).error().what, "17 of 16 bits"));
    CHECK(holds(read(24, 24, false, pixels).error().what, "24 of 24 bits"));
    CHECK(holds(read(1, 1, false, pixels).error().what, "single bits"));
    CHECK(holds(read(16, 16, false, "a").error().what, "more pixels than the file can hold"));
}

TEST_CASE("slices with scales of their own, and compressed ones, have the values that they were given") {
    const SeriesFolder scaled;
    for (int n = 0; n < 3; ++n)
        scaled.put(n, SeriesFolder::slice(n).elements().decimals(0x00281053, {1.0 + n}).decimals(0x00281052, {0.5}));
    const volume::Volume volume = scaled.good();
    for (int n = 0; n < 3; ++n) CHECK(volume::value_at(volume, {3, 2, n}) == (1.0 + n) * (12.0 * n + 11.0) + 0.5);

    using Type = gdcm::TransferSyntax;
    for (const auto type :
         {Type::JPEGLosslessProcess14_1, Type::JPEGLSLossless, Type::JPEG2000Lossless, Type::RLELossless}) {
        CAPTURE(static_cast<int>(type));
        const SeriesFolder series;
        const auto value = [](int x, int y, int z) { return (x * 7919 + y * 104729 + z * 31) % 3000 - 1000; };
        constexpr int kSize = 64;
        for (int n = 0; n < 4; ++n) {
            DicomSliceFile slice = SeriesFolder::slice(n);
            slice.size = {kSize, kSize};
            slice.values.clear();
            for (int i = 0; i < kSize * kSize; ++i)
                slice.values.push_back(static_cast<std::int16_t>(value(i % kSize, i / kSize, n)));
            series.put(n, slice.elements());
        }
        for (const std::string& name : series.folder.names()) REQUIRE(compress(series.folder.path() / name, type));
        const volume::Volume read = series.good("7.dcm");
        for (int z = 0; z < 4; ++z)
            for (int i = 0; i < kSize * kSize; ++i)
                if (volume::value_at(read, {i % kSize, i / kSize, z}) != value(i % kSize, i / kSize, z) - 1024)
                    FAIL("voxel " << i << " of slice " << z);
        const std::string bytes = series.folder.text("0.dcm");
        for (std::size_t n = 0; n < 20; ++n) CHECK_FALSE(from_memory(bytes.substr(0, bytes.size() * n / 20)));
    }
}

TEST_CASE("frames of one file are slices, wherever their groups say") {
    DicomElements file = SeriesFolder::slice(0).elements();
    file.remove(0x00200032).remove(0x00200037).remove(0x00280030).remove(0x00281052).remove(0x00281053);
    file.text(0x00080016, "UI", "1.2.840.10008.5.1.4.1.1.4.1").text(0x00080060, "CS", "MR");
    file.text(0x00280008, "IS", "3");
    DicomElements shared;
    shared.items(0x00209116, {DicomElements().decimals(0x00200037, {1, 0, 0, 0, 1, 0})});
    shared.items(0x00289110, {DicomElements().decimals(0x00280030, {0.75, 0.5})});
    std::vector<DicomElements> each;
    std::vector<std::int16_t> values;
    for (const int n : {2, 0, 1}) { // out of order
        DicomElements frame;
        frame.items(0x00209113, {DicomElements().decimals(0x00200032, {10, 20, 2.5 * n})});
        frame.items(0x00289145, {DicomElements().decimals(0x00281053, {2}).decimals(0x00281052, {1.0 * n})});
        each.push_back(frame);
        for (int pixel = 0; pixel < 12; ++pixel) values.push_back(static_cast<std::int16_t>(100 * n + pixel));
    }
    file.items(0x52009229, {shared}).items(0x52009230, each).pixels(test::bytes_of(values), 2);
    for (const DicomSyntax syntax : {DicomSyntax::kExplicit, DicomSyntax::kImplicit, DicomSyntax::kBigEndian}) {
        for (const DicomLengths lengths : {DicomLengths::kKnown, DicomLengths::kOpen}) {
            const auto volume = from_memory(file.file(syntax, lengths));
            REQUIRE_MESSAGE(volume, (volume ? "" : volume.error().message()));
            REQUIRE(volume->size == glm::ivec3(4, 3, 3));
            for (int n = 0; n < 3; ++n) CHECK(volume::value_at(*volume, {3, 1, n}) == 2 * (100 * n + 7) + n);
            CHECK(test::place(*volume, {1, 1, 1}) == glm::dvec3(-10.5, -20.75, 2.5));
        }
    }
    file.text(0x00280008, "IS", "100000000");
    CHECK(holds(from_memory(file.file()).error().what, "other frames than it describes"));
    file.remove(0x52009230);
    CHECK(holds(from_memory(file.file()).error().what, "do not say where they lie"));
}

TEST_CASE("DICOM that is no volume of grey values is refused with a word") {
    const auto with = [](auto change) {
        DicomElements elements = SeriesFolder::slice(0).elements();
        change(elements);
        const auto volume = from_memory(elements.file());
        REQUIRE_FALSE(volume);
        CHECK(volume.error().where == "memory.dcm");
        CHECK_FALSE(volume.error().hint.empty());
        return volume.error().what;
    };
    CHECK(holds(with([](auto& e) { e.number(0x00280002, 3); }), "colours"));
    CHECK(holds(with([](auto& e) { e.text(0x00280004, "CS", "PALETTE COLOR"); }), "colours"));
    CHECK(holds(with([](auto& e) { e.remove(0x00200032); }), "where they lie"));
    CHECK(holds(with([](auto& e) { e.remove(0x00200037); }), "where they lie"));
    CHECK(holds(with([](auto& e) { e.remove(0x00280030); }), "how far pixels are apart"));
    CHECK(holds(with([](auto& e) { e.text(0x00280030, "DS", "0\\1"); }), "not a length"));
    CHECK(holds(with([](auto& e) { e.text(0x00200037, "DS", "1\\0\\0\\1\\0\\0"); }), "no pair of directions"));
    CHECK(holds(with([](auto& e) { e.text(0x00200032, "DS", "0\\0\\1e30"); }), "10 km"));
    CHECK(holds(with([](auto& e) { e.number(0x00280010, 0); }), "no rows or columns"));
    CHECK(holds(with([](auto& e) { e.number(0x00280010, 65535).number(0x00280011, 65535); }), "more pixels than"));
    std::string deflated = SeriesFolder::slice(0).elements().file();
    const std::size_t at = deflated.find("1.2.840.10008.1.2.1");
    deflated.replace(at, 22, "1.2.840.10008.1.2.1.99").erase(at + 22, 2);
    CHECK_FALSE(from_memory(deflated));

    const std::string gzip = test::compressed(SeriesFolder::slice(0).elements().file(), test::Wrapper::kGzip);
    CHECK(from_memory(gzip));
    const TemporaryFolder folder;
    Job job;
    CHECK(io::read_volume(folder.write("a.dcm", gzip), {}, job));
    job.cancel();
    CHECK(io::read_volume(folder.write("a.dcm", SeriesFolder::slice(0).elements().file()), {}, job).error().what ==
          "cancelled");
}

TEST_CASE("a DICOM file that was cut short or damaged is refused, alone and in its folder" *
          doctest::test_suite("slow")) {
    const SeriesFolder series;
    series.put_all(5);
    const std::string bytes = series.folder.text("7.dcm"); // slice 1
    for (std::size_t n = 0; n < 20; ++n) {
        const std::string cut = bytes.substr(0, bytes.size() * n / 20);
        series.folder.write("7.dcm", cut);
        CAPTURE(n);
        CHECK_FALSE(series.read("7.dcm"));
        CHECK_FALSE(series.read()); // a slice is missing
        CHECK_FALSE(from_memory(cut));
    }
    series.folder.write("7.dcm", bytes.substr(0, bytes.size() - 1));
    CHECK(holds(series.read().error().what, "the file ends before"));
    // Beside a whole series it is named.
    series.put(1, SeriesFolder::slice(1).elements());
    series.folder.write("cut.dcm", bytes.substr(0, bytes.size() - 1));
    check_numbered(series.good(), 5);
    CHECK(holds(series.good().notes.at(0), "cut.dcm: the file ends before"));

    // Lengths that claim gigabytes, in the header and in sequences.
    DicomElements nested = SeriesFolder::slice(0).elements();
    nested.items(0x00081140, {DicomElements().text(0x00081150, "UN", std::string(100, 'x'))});
    for (const DicomSyntax syntax : {DicomSyntax::kExplicit, DicomSyntax::kImplicit}) {
        std::string claims = nested.file(syntax);
        const std::size_t at = claims.find("xxxx") - 4;
        claims.replace(at, 4, "\x00\xff\xff\x7f", 4);
        CHECK_FALSE(from_memory(claims));
    }
    DicomElements deep;
    for (int n = 0; n < 3000; ++n) deep = DicomElements().items(0x00081140, {deep});
    CHECK_FALSE(from_memory(deep.file(DicomSyntax::kExplicit, DicomLengths::kOpen)));

    std::mt19937 random(3);
    for (int n = 0; n < 3000; ++n) { // ends in a volume or in an error
        std::string damaged = nested.file(n % 2 == 0 ? DicomSyntax::kExplicit : DicomSyntax::kImplicit);
        for (unsigned hits = 1 + random() % 4; hits > 0; --hits)
            damaged[132 + random() % (damaged.size() - 132)] = static_cast<char>(random());
        const auto volume = from_memory(damaged, 1e9);
        if (!volume) CHECK_FALSE(volume.error().what.empty());
    }
}
