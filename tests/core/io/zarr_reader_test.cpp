// Zarr as the storage specification of version 2 and OME-NGFF have it: chunks, orders, fill values, levels and axes;
// and what is refused. tests/cli/test_microscopy.py compares with zarr of Python.
#include "core/io/recognise.h"
#include "core/io/volumes/volume_file.h"
#include "tests/support/volume_files.h"

#include <algorithm>
#include <cmath>
#include <doctest/doctest.h>

using namespace ramus;
using test::holds;

namespace {

namespace fs = std::filesystem;

// A folder with an array of 2 x 2 x 4 numbers (z, y, x) of 8 bits, 0 to 15, in chunks of 2 x 2 x 3.
struct ZarrFolder {
    TemporaryFolder folder;

    static std::string text(const std::string& changed = {}) {
        return R"({"zarr_format": 2, "shape": [2, 2, 4], "chunks": [2, 2, 3], "dtype": "|u1", "compressor": null,
                   "fill_value": 7, "order": "C", "filters": null)" +
               changed + "}";
    }
    ZarrFolder() {
        write(".zarray", text());
        write("0.0.0", {0, 1, 2, 4, 5, 6, 8, 9, 10, 12, 13, 14});
        write("0.0.1", {3, 99, 99, 7, 99, 99, 11, 99, 99, 15, 99, 99});
    }
    void write(const std::string& name, const std::string& bytes) const {
        fs::create_directories((folder.path() / name).parent_path());
        folder.write(name, bytes);
    }
    void write(const std::string& name, std::initializer_list<char> numbers) const {
        write(name, std::string(numbers));
    }
    [[nodiscard]] Result<volume::Volume> read(const std::string& below = {}, io::VolumePart part = {}) const {
        Job job;
        return io::read_volume(below.empty() ? folder.path() : folder.path() / below, {0.0, {}, part}, job);
    }
    [[nodiscard]] std::string refusal(const std::string& below = {}) const {
        const auto volume = read(below);
        REQUIRE_FALSE(volume);
        CHECK(volume.error().where.find(folder.path().string()) != std::string::npos);
        CHECK_FALSE(volume.error().hint.empty());
        return volume.error().what;
    }
};

void check_counting_chunks(const Result<volume::Volume>& volume) {
    REQUIRE_MESSAGE(volume, (volume ? "" : volume.error().message()));
    int n = 0;
    for (int k = 0; k < volume->size.z; ++k)
        for (int j = 0; j < volume->size.y; ++j)
            for (int i = 0; i < volume->size.x; ++i, ++n)
                CHECK(volume::value_at(*volume, {i, j, k}) == static_cast<double>(n));
}

bool zarr_notes_say(const std::vector<std::string>& notes, const char* words) {
    return std::ranges::any_of(notes, [&](const std::string& note) { return note.find(words) != std::string::npos; });
}

} // namespace

TEST_CASE("a folder of chunks is a volume") {
    const ZarrFolder zarr;
    CHECK(io::is_volume(zarr.folder.path()));
    const auto volume = zarr.read();
    check_counting_chunks(volume);
    CHECK(volume->size == glm::ivec3(4, 2, 2));
    CHECK(volume->type == "Zarr, uint8");
    CHECK(zarr_notes_say(volume->notes, "axes: taken as z, y, x"));
    CHECK_FALSE(volume::says_sides(*volume));
}

TEST_CASE("chunks may be in folders, compressed, missing, or with the first axis fastest") {
    SUBCASE("in folders") {
        ZarrFolder zarr;
        for (const char* last : {"0", "1"}) {
            const std::string bytes = zarr.folder.text(std::string("0.0.") + last);
            fs::remove(zarr.folder.path() / (std::string("0.0.") + last));
            zarr.write(std::string("0/0/") + last, bytes);
        }
        check_counting_chunks(zarr.read());
        zarr.write(".zarray", ZarrFolder::text(R"(, "dimension_separator": "/")"));
        check_counting_chunks(zarr.read());
        zarr.write(".zarray", ZarrFolder::text(R"(, "dimension_separator": ".")"));
        CHECK(holds(zarr.refusal(), "none of its chunks is there"));
    }
    SUBCASE("compressed") {
        ZarrFolder zarr;
        std::string text = ZarrFolder::text();
        text.replace(text.find("null"), 4, R"({"id": "zlib", "level": 1})");
        zarr.write(".zarray", text);
        zarr.write("0.0.0", test::compressed(zarr.folder.text("0.0.0"), test::Wrapper::kZlib));
        zarr.write("0.0.1", test::compressed(zarr.folder.text("0.0.1"), test::Wrapper::kGzip));
        check_counting_chunks(zarr.read());
        zarr.write("0.0.1", test::compressed(std::string(13, '\1'), test::Wrapper::kZlib));
        CHECK_FALSE(zarr.refusal().empty());
        zarr.write("0.0.1", test::compressed(std::string(11, '\1'), test::Wrapper::kZlib));
        CHECK(holds(zarr.refusal(), "holds 11 bytes, and the array says 12"));
    }
    SUBCASE("missing") {
        ZarrFolder zarr;
        fs::remove(zarr.folder.path() / "0.0.1");
        const auto volume = zarr.read();
        REQUIRE(volume);
        CHECK(volume::value_at(*volume, {2, 1, 1}) == 14.0);
        CHECK(volume::value_at(*volume, {3, 1, 1}) == 7.0);
    }
    SUBCASE("the first axis fastest") {
        ZarrFolder zarr;
        std::string text = ZarrFolder::text();
        text.replace(text.find("\"C\""), 3, "\"F\"");
        zarr.write(".zarray", text);
        zarr.write("0.0.0", {0, 8, 4, 12, 1, 9, 5, 13, 2, 10, 6, 14});
        zarr.write("0.0.1", {3, 11, 7, 15, 99, 99, 99, 99, 99, 99, 99, 99});
        check_counting_chunks(zarr.read());
    }
}

TEST_CASE("an OME-Zarr image gives its finest level, with its axes and distances") {
    const ZarrFolder zarr;
    zarr.write("image/.zgroup", R"({"zarr_format": 2})");
    const auto attributes = [](const std::string& fine) {
        return R"({"multiscales": [{"version": "0.4", "axes": [{"name": "z", "type": "space", "unit": "micrometer"},
            {"name": "y", "type": "space", "unit": "micrometer"}, {"name": "x", "type": "space", "unit": "nanometer"}],
            "datasets": [{"path": "coarse", "coordinateTransformations": [{"type": "scale", "scale": [4, 1, 2000]}]},
            {"path": ")" +
               fine + R"(", "coordinateTransformations": [{"type": "scale", "scale": [2, 0.5, 500]},
            {"type": "translation", "translation": [10, 0, 0]}]}],
            "coordinateTransformations": [{"type": "scale", "scale": [2, 1, 1]}]}]})";
    };
    zarr.write("image/.zattrs", attributes("fine"));
    zarr.write("image/fine/.zarray", ZarrFolder::text());
    for (const char* name : {"0.0.0", "0.0.1"}) zarr.write(std::string("image/fine/") + name, zarr.folder.text(name));
    std::string coarse = ZarrFolder::text();
    coarse.replace(coarse.find("[2, 2, 4]"), 9, "[2, 1, 2]");
    zarr.write("image/coarse/.zarray", coarse);
    zarr.write("image/coarse/0.0.0", zarr.folder.text("0.0.0"));
    for (const char* path : {"image", "image/fine"}) {
        const auto volume = zarr.read(path);
        check_counting_chunks(volume);
        const glm::dvec3 spacing = volume::spacing_mm(volume->to_patient);
        CHECK(std::abs(spacing.x - 0.0005) < 1e-12);
        CHECK(std::abs(spacing.y - 0.0005) < 1e-12);
        CHECK(std::abs(spacing.z - 0.004) < 1e-12);
        CHECK(std::abs(volume->to_patient[3].z - 0.02) < 1e-12); // 10 um, scaled by 2
        CHECK(volume->type == "OME-Zarr 0.4, uint8");
        CHECK(volume->unit_mm.has_value());
    }
    CHECK(zarr_notes_say(zarr.read("image")->notes, "2 levels of detail, coarse, fine: read fine"));
    CHECK(zarr.read("image/coarse")->size == glm::ivec3(2, 1, 2));
    for (const char* out : {"../secret", "/etc", "fine/../../.."}) {
        zarr.write("image/.zattrs", attributes(out));
        CHECK(holds(zarr.refusal("image"), "leads out of the folder"));
    }
    zarr.write("image/.zattrs", "[" + std::string(100'000, '['));
    CHECK_FALSE(zarr.refusal("image").empty());
    zarr.write("image/.zattrs", "{}");
    CHECK(holds(zarr.refusal("image"), "holds no image"));
}

TEST_CASE("damaged arrays are refused, and take neither memory nor time") {
    const ZarrFolder zarr;
    const auto refusal = [&](const std::string& from, const std::string& to) {
        std::string text = ZarrFolder::text();
        text.replace(text.find(from), from.size(), to);
        zarr.write(".zarray", text);
        return zarr.refusal();
    };
    CHECK(holds(refusal("\"zarr_format\": 2", "\"zarr_format\": 3"), "version of Zarr"));
    CHECK(holds(refusal("|u1", "<f2"), "dtype"));
    CHECK(holds(refusal("\"compressor\": null", R"("compressor": {"id": "bz2"})"), "bz2"));
    CHECK(holds(refusal("\"filters\": null", R"("filters": [{"id": "delta"}])"), "delta"));
    CHECK(holds(refusal("\"fill_value\": 7", "\"fill_value\": 700"), "fill_value"));
    CHECK(holds(refusal("[2, 2, 4]", "[2, 2]"), "equally many"));
    CHECK(holds(refusal("[2, 2, 4]", "[2, 0, 4]"), "equally many"));
    CHECK(holds(refusal("[2, 2, 3]", "[2, 2, -3]"), "equally many"));
    CHECK(holds(refusal("[2, 2, 4]", "[2, 2, 99999999999]"), "extent along axis 1"));
    CHECK_FALSE(refusal("[2, 2, 4]", "[2000000000, 2000000000, 1000]").empty());
    CHECK_FALSE(refusal("[2, 2, 3]", "[2000000000, 2000000000, 2000000000]").empty());
    CHECK_FALSE(refusal("[2, 2, 3]", "[18446744073709551615, 18446744073709551615, 2]").empty());
    zarr.write(".zarray", ZarrFolder::text());
    zarr.write("0.0.1", std::string(13, 'x'));
    CHECK(holds(zarr.refusal(), "has 13 bytes, and its numbers take 12"));
    zarr.write("0.0.1", std::string(11, 'x'));
    CHECK(holds(zarr.refusal(), "holds 11 bytes"));
    zarr.write("0.0.1", std::string());
    CHECK(holds(zarr.refusal(), "a chunk is empty"));
    // Blosc: version, versionlz, flags, typesize, then nbytes, blocksize and cbytes, 32 bits each.
    std::string text = ZarrFolder::text();
    text.replace(text.find("null"), 4, R"({"id": "blosc", "cname": "lz4"})");
    zarr.write(".zarray", text);
    zarr.write("0.0.1", std::string("\2\1\2\1\xFF\xFF\xFF\x7F\xFF\xFF\xFF\x7F\x14\0\0\0\0\0\0\0", 20));
    CHECK(holds(zarr.refusal(), "blosc"));
    zarr.write("0.0.0", "short");
    CHECK(holds(zarr.refusal(), "shorter than the header"));
}
