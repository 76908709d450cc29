// TIFF as its specification has it: byte orders, pages, strips and tiles; descriptions of ImageJ and OME; stacks of
// files; and what is refused. tests/cli/test_microscopy.py compares all kinds with tifffile.
#include "core/io/recognise.h"
#include "core/io/volumes/tiff/tiff_stack.h"
#include "core/io/volumes/volume_file.h"
#include "tests/support/tiff_file.h"
#include "tests/support/volume_files.h"

#include <algorithm>
#include <cmath>
#include <doctest/doctest.h>

using namespace ramus;
using test::holds;
using test::TiffFileText;

namespace {

// Two pages of 3 x 2 numbers of 8 bits, 0 to 11.
TiffFileText two_pages() {
    TiffFileText file;
    for (char page = 0; page < 2; ++page) {
        std::string pixels;
        for (char n = 0; n < 6; ++n) pixels += static_cast<char>(6 * page + n);
        file.add(3, 2, pixels);
    }
    return file;
}

void check_counting_pages(const volume::Volume& volume, int first = 0, int step = 1) {
    int n = first;
    for (int k = 0; k < volume.size.z; ++k)
        for (int j = 0; j < volume.size.y; ++j)
            for (int i = 0; i < volume.size.x; ++i, n += step)
                CHECK(volume::value_at(volume, {i, j, k}) == static_cast<double>(n));
}

bool tiff_near(double a, double b) { return std::abs(a - b) <= 1e-9 * std::abs(b); }

bool tiff_notes_say(const std::vector<std::string>& notes, const char* words) {
    return std::ranges::any_of(notes, [&](const std::string& note) { return note.find(words) != std::string::npos; });
}

} // namespace

TEST_CASE("pages are slices, in both byte orders, as TIFF and as BigTIFF") {
    const test::VolumeFiles files{"a.tif"};
    for (const bool big_endian : {false, true})
        for (const bool big : {false, true}) {
            CAPTURE(big_endian);
            CAPTURE(big);
            TiffFileText file = two_pages();
            file.big_endian = big_endian;
            file.big = big;
            const volume::Volume volume = files.good(file.bytes());
            CHECK(volume.size == glm::ivec3(3, 2, 2));
            check_counting_pages(volume);
            CHECK(volume.type == (big ? "BigTIFF, uint8" : "TIFF, uint8"));
            CHECK_FALSE(volume.unit_mm);
            CHECK_FALSE(volume::says_sides(volume));
            CHECK(volume::orientation(volume.to_patient) == "LPS");
        }
}

TEST_CASE("numbers of 16 bits, tiles and single bits") {
    const test::VolumeFiles files{"a.tif"};
    TiffFileText wide;
    wide.big_endian = true;
    wide.add(3, 1, test::bytes_of(std::vector<std::uint16_t>{1000, 2000, 3000}, true), 16);
    check_counting_pages(files.good(wide.bytes()), 1000, 1000);

    // Two tiles of 8 x 2, of which 10 x 2 pixels are in the page.
    TiffFileText tiled;
    std::string left, right;
    for (char row = 0; row < 2; ++row)
        for (char n = 0; n < 8; ++n) {
            left += static_cast<char>(10 * row + n);
            right += static_cast<char>(n < 2 ? 10 * row + 8 + n : 99);
        }
    auto& page = tiled.add(10, 2, "");
    page.strips = {left, right};
    const auto fill = [&](std::vector<std::uint64_t> offsets) {
        page.set(322, 4, {8}).set(323, 4, {2}).set(324, 4, std::move(offsets)).set(325, 4, {16, 16});
    };
    fill({8, 24}); // behind the header of 8 bytes
    check_counting_pages(files.good(tiled.bytes()));

    TiffFileText bits;
    bits.add(10, 2, std::string("\x80\x40\x01\xC0", 4), 1);
    const volume::Volume mask = files.good(bits.bytes());
    CHECK(mask.type == "TIFF, single bits");
    CHECK(volume::value_at(mask, {0, 0, 0}) == 1.0);
    CHECK(volume::value_at(mask, {9, 0, 0}) == 1.0);
    CHECK(volume::value_at(mask, {7, 1, 0}) == 1.0);
    CHECK(volume::value_at(mask, {8, 1, 0}) == 1.0);
    CHECK(volume::value_at(mask, {1, 0, 0}) == 0.0);
}

TEST_CASE("distances come from ImageJ, OME or the resolution, or are assumed") {
    const test::VolumeFiles files{"a.tif"};
    const auto read = [&](const std::string& description, std::uint64_t unit) {
        TiffFileText file = two_pages();
        for (auto& page : file.pages) page.set(282, 5, {4, 1}).set(283, 5, {5, 1}).set(296, 3, {unit});
        if (!description.empty()) file.pages[0].describe(description);
        return files.good(file.bytes());
    };
    const auto spacing = [](const volume::Volume& volume) { return volume::spacing_mm(volume.to_patient); };

    const auto imagej = read("ImageJ=1.54\nimages=2\nslices=2\nunit=micron\nspacing=-3.0\n", 1);
    CHECK(tiff_near(spacing(imagej).x, 0.25e-3));
    CHECK(tiff_near(spacing(imagej).y, 0.2e-3));
    CHECK(tiff_near(spacing(imagej).z, 3e-3)); // ImageJ writes the sign of its axis
    CHECK(imagej.unit_mm == 1e-3);
    CHECK(imagej.type == "TIFF of ImageJ, uint8");

    const auto ome = read("<?xml version=\"1.0\"?><OME><Image><Pixels DimensionOrder=\"XYZCT\" SizeX=\"3\" SizeY=\"2\" "
                          "SizeZ=\"2\" SizeC=\"1\" SizeT=\"1\" PhysicalSizeX=\"0.5\" PhysicalSizeY=\"500\" "
                          "PhysicalSizeYUnit=\"nm\" PhysicalSizeZ=\"0.002\" PhysicalSizeZUnit=\"mm\"/></Image></OME>",
                          1);
    CHECK(tiff_near(spacing(ome).x, 0.5e-3));
    CHECK(tiff_near(spacing(ome).y, 0.5e-3));
    CHECK(tiff_near(spacing(ome).z, 2e-3));

    const auto cm = read("", 3);
    CHECK(tiff_near(spacing(cm).x, 2.5));
    CHECK(tiff_near(spacing(cm).y, 2.0));
    CHECK(tiff_near(spacing(cm).z, 2.5));
    CHECK(tiff_notes_say(cm.notes, "along z"));
    CHECK(cm.unit_mm == 10.0);

    const auto none = read("", 1);
    CHECK(spacing(none) == glm::dvec3(1.0));
    CHECK(tiff_notes_say(none.notes, "taken as 1 mm"));

    TiffFileText print = two_pages();
    for (auto& page : print.pages) page.set(282, 5, {72, 1}).set(283, 5, {72, 1}).set(296, 3, {2});
    CHECK(tiff_notes_say(files.good(print.bytes()).suspicions, "72 pixels in an inch"));
}

TEST_CASE("one of several channels and time points is chosen") {
    const test::VolumeFiles files{"a.tif"};
    TiffFileText file; // channels first, then slices, then times
    for (char n = 0; n < 12; ++n) file.add(1, 1, std::string(1, n));
    file.pages[0].describe("ImageJ=1.54\nimages=12\nchannels=2\nslices=3\nframes=2\n");
    const auto path = files.folder.write("a.tif", file.bytes());
    Job job;
    CHECK(holds(files.refusal(file.bytes()), "2 channels: 1, 2"));
    for (int channel = 1; channel <= 2; ++channel)
        for (int time = 1; time <= 2; ++time) {
            const auto volume = io::read_volume(path, {0.0, {}, {channel, time}}, job);
            REQUIRE(volume);
            CHECK(volume->size == glm::ivec3(1, 1, 3));
            check_counting_pages(*volume, (channel - 1) + 6 * (time - 1), 2);
        }
    CHECK(holds(io::read_volume(path, {0.0, {}, {3, 1}}, job).error().what, "no channel 3"));
    CHECK(holds(io::read_volume(path, {0.0, {}, {1, {}}}, job).error().what, "2 time points"));
}

TEST_CASE("ImageJ's planes without pages are read") {
    const test::VolumeFiles files{"a.tif"};
    TiffFileText file;
    auto& page = file.add(2, 1, std::string(2, '\0'));
    page.describe("ImageJ=1.54\nimages=3\nslices=3\n");
    page.strips.clear();
    page.set(279, 4, {2}).set(273, 4, {0});
    const auto length = static_cast<std::uint64_t>(file.bytes().size());
    page.set(273, 4, {length});
    std::string bytes = file.bytes();
    for (char n = 0; n < 6; ++n) bytes += n;
    check_counting_pages(files.good(bytes));
    bytes.pop_back();
    CHECK(holds(files.refusal(bytes), "beyond the end of the file"));
}

TEST_CASE("files whose names count are a stack") {
    const TemporaryFolder folder;
    for (int n = 8; n < 12; ++n) {
        TiffFileText file;
        file.add(2, 1, std::string{static_cast<char>(2 * (n - 8)), static_cast<char>(2 * (n - 8) + 1)});
        folder.write("z" + std::to_string(n) + ".tif", file.bytes());
    }
    folder.write("notes.txt", "no slice");
    Job job;
    for (const auto& path : {folder.path(), folder.path() / "z9.tif"}) {
        const auto volume = io::read_volume(path, {}, job);
        REQUIRE(volume);
        CHECK(volume->size == glm::ivec3(2, 1, 4));
        check_counting_pages(*volume);
        CHECK(tiff_notes_say(volume->notes, "stack of 4 files, z8.tif to z11.tif"));
    }
    std::filesystem::remove(folder.path() / "z10.tif");
    CHECK(
        holds(io::read_volume(folder.path(), {}, job).error().what, "slice 10 is missing between z9.tif and z11.tif"));
    std::filesystem::remove(folder.path() / "z9.tif");
    CHECK(holds(io::read_volume(folder.path() / "z8.tif", {}, job).error().what, "slices 9 to 10 are missing"));
    folder.write("z08.tif", folder.text("z8.tif"));
    CHECK(holds(io::tiff_stack_in(folder.path()).error().what, "the same number: z"));
    std::filesystem::remove(folder.path() / "z08.tif");
    folder.write("other.tif", folder.text("z8.tif"));
    CHECK(holds(io::tiff_stack_in(folder.path()).error().what, "are not one stack"));
}

TEST_CASE("what is no volume of numbers is refused with the reason") {
    const test::VolumeFiles files{"a.tif"};
    const auto refusal = [&](std::uint16_t tag, std::vector<std::uint64_t> values) {
        TiffFileText file = two_pages();
        file.pages[1].set(tag, tag == 258 || tag == 262 || tag == 277 ? 3 : 4, std::move(values));
        return files.refusal(file.bytes());
    };
    CHECK(holds(refusal(277, {3}), "in colour"));
    CHECK(holds(refusal(262, {3}), "palette"));
    CHECK(holds(refusal(258, {12}), "differ"));
    CHECK(holds(refusal(256, {4}), "differ"));
    CHECK(holds(refusal(259, {6}), "compression, number 6, is not read"));
    CHECK(holds(refusal(259, {5}), "LZW) cannot be decoded"));
    CHECK(holds(refusal(278, {1}), "it has 1 strips where its size needs 2"));
    CHECK(holds(refusal(278, {0}), "make no sense"));
    CHECK(holds(refusal(279, {5}), "has 5 bytes, and its pixels take 6"));
    CHECK(holds(refusal(273, {4'000'000'000}), "beyond the end of the file"));
    TiffFileText half;
    half.add(2, 1, std::string(4, '\0'), 16).set(339, 3, {3});
    CHECK(holds(files.refusal(half.bytes()), "numbers of 16 bits with fractions"));
}

TEST_CASE("damaged files are refused, and take neither memory nor time") {
    const test::VolumeFiles files{"a.tif"};
    TiffFileText cycle = two_pages();
    for (const int back : {0, 1}) {
        cycle.back_to = back;
        CHECK(holds(files.refusal(cycle.bytes()), "leads from page 2 back"));
    }
    // 2^40 pixels in a few bytes, uncompressed and compressed.
    for (const std::uint64_t compression : {1U, 5U, 50000U}) {
        TiffFileText huge;
        huge.add(1 << 20, 1 << 20, "12345678").set(259, 3, {compression});
        CHECK_FALSE(files.refusal(huge.bytes()).empty());
    }
    TiffFileText claims;
    claims.add(1, 1, "1").set(273, 16, {1, 2, 3, 4}).set(279, 16, {~0ULL, 2, 3, 4});
    CHECK_FALSE(files.refusal(claims.bytes()).empty());
    const std::string whole = two_pages().bytes();
    for (std::size_t length = 4; length < whole.size(); ++length) {
        Job job;
        CHECK_FALSE(io::read_volume(files.folder.write("cut.tif", whole.substr(0, length)), {}, job).has_value());
    }
    TiffFileText ome = two_pages();
    ome.pages[0].describe(
        "<OME><Image><Pixels DimensionOrder=\"XYZCT\" SizeZ=\"9\" SizeC=\"1\" SizeT=\"1\"/></Image></OME>");
    CHECK(holds(files.refusal(ome.bytes()), "9 planes, and the file has 2 pages"));
    ome.pages[0].describe("<OME><Image><Pixels");
    CHECK(holds(files.refusal(ome.bytes()), "OME description"));
}
