// NRRD as its format description has it: every type, byte order, encoding and way to say where voxels lie; and what is
// refused.
#include "core/io/recognise.h"
#include "core/io/volumes/volume_file.h"
#include "tests/support/volume_files.h"

#include <doctest/doctest.h>
#include <glm/geometric.hpp>
#include <limits>
#include <random>

using namespace ramus;
using test::holds;

namespace {

// A header of 2 x 3 x 4 bytes, of which fields can be changed, added and, by an empty value, left out.
struct NrrdText {
    std::vector<std::pair<std::string, std::string>> fields{{"type", "uchar"},
                                                            {"dimension", "3"},
                                                            {"sizes", "2 3 4"},
                                                            {"encoding", "raw"},
                                                            {"space", "right-anterior-superior"},
                                                            {"space directions", "(1,0,0) (0,1,0) (0,0,1)"},
                                                            {"space origin", "(0,0,0)"},
                                                            {"space units", R"("mm" "mm" "mm")"}};
    std::string values;

    NrrdText() {
        for (char n = 0; n < 24; ++n) values += n;
    }
    NrrdText& set(const std::string& field, const std::string& value) {
        const auto known = std::ranges::find(fields, field, &std::pair<std::string, std::string>::first);
        if (known == fields.end())
            fields.emplace_back(field, value);
        else
            known->second = value;
        return *this;
    }
    [[nodiscard]] std::string header() const {
        std::string text = "NRRD0005\n# as Slicer writes it\n";
        for (const auto& [field, value] : fields)
            if (!value.empty()) text += field + ": " + value + "\n";
        return text + "Segment0_Name:=a: segment\n";
    }
    [[nodiscard]] std::string bytes() const { return header() + "\n" + values; }
};

template <class T> void check_nrrd_type(const std::vector<const char*>& words, const std::vector<T>& values) {
    const test::VolumeFiles files{"a.nrrd"};
    std::string text;
    for (const T value : values) text += " " + std::to_string(value) + (value == values[1] ? "\n" : "");
    const auto check = [&](const NrrdText& file) {
        const volume::Volume volume = files.good(file.bytes());
        REQUIRE(volume::voxel_count(volume.size) == values.size());
        for (std::size_t n = 0; n < values.size(); ++n)
            CHECK(volume::value_at(volume, {static_cast<int>(n), 0, 0}) == static_cast<double>(values[n]));
    };
    for (const char* word : words) {
        CAPTURE(word);
        NrrdText file;
        file.set("type", word).set("sizes", std::to_string(values.size()) + " 1 1");
        for (const bool big : {false, true}) {
            const std::string bytes = test::bytes_of(values, big);
            file.set("endian", big ? "big" : "little").set("encoding", "raw");
            file.values = bytes;
            check(file);
            for (const test::Wrapper wrapper : {test::Wrapper::kGzip, test::Wrapper::kZlib}) {
                file.set("encoding", wrapper == test::Wrapper::kGzip ? "gzip" : "gz");
                file.values = test::compressed(bytes, wrapper);
                check(file);
            }
        }
        file.set("encoding", "ascii").set("endian", "").values = text;
        check(file);
    }
}

} // namespace

TEST_CASE("NRRD values of every type, byte order and encoding are read as they are") {
    check_nrrd_type<std::int8_t>({"signed char", "int8", "int8_t"}, {0, -128, 127, 5});
    check_nrrd_type<std::uint8_t>({"uchar", "unsigned char", "uint8", "uint8_t"}, {0, 1, 200, 255});
    check_nrrd_type<std::int16_t>({"short", "signed short int", "int16_t"}, {0, -1024, 3071, 1});
    check_nrrd_type<std::uint16_t>({"ushort", "unsigned short", "uint16"}, {0, 1, 65535, 300});
    check_nrrd_type<std::int32_t>({"int", "int32_t"}, {0, -2147483647 - 1, 2147483647, 70000});
    check_nrrd_type<std::uint32_t>({"uint", "unsigned int"}, {0, 1, 2147483647, 70000});
    check_nrrd_type<std::int64_t>({"longlong", "long long", "int64", "int64_t"}, {0, -70000, 2147483647, 1});
    check_nrrd_type<std::uint64_t>({"ulonglong", "uint64_t"}, {0, 1, 2147483647, 70000});
    check_nrrd_type<float>({"float"}, {0.0F, -1.5F, 1e6F, 0.25F});
    check_nrrd_type<double>({"double"}, {0.0, -1.5, 1e6, 0.25});
}

TEST_CASE("where the voxels of NRRD lie: every space, directions, spacings, origins and units") {
    const test::VolumeFiles files{"a.nrrd"};
    NrrdText file;
    const auto place = [&](const glm::dvec3& voxel) { return test::place(files.good(file.bytes()), voxel); };
    const auto notes = [&] { return files.good(file.bytes()).notes.size(); };
    file.set("space directions", "(0,2,0) ( 0, 0, 3 ) (4,0,1)").set("space origin", "(10,20,30)");
    CHECK(place({1, 2, 3}) == glm::dvec3(22, 22, 39)); // 10 + 3 * 4, 20 + 2, 30 + 2 * 3 + 3
    CHECK(notes() == 0);
    for (const char* space : {"left-posterior-superior", "LPS", "left-posterior-superior-time", "LPST"}) {
        file.set("space", space);
        CHECK(place({1, 2, 3}) == glm::dvec3(-22, -22, 39));
    }
    for (const char* space : {"left-anterior-superior", "LAS"}) {
        file.set("space", space);
        CHECK(place({1, 2, 3}) == glm::dvec3(-22, 22, 39));
    }
    for (const char* space : {"scanner-xyz", "3D-right-handed"}) {
        file.set("space", space);
        CHECK(place({1, 2, 3}) == glm::dvec3(22, 22, 39));
        CHECK(notes() == 1);
    }
    file.set("space", "").set("space dimension", "3");
    CHECK(notes() == 1);

    file = NrrdText();
    file.set("space units", R"("um" "um" "um")");
    CHECK(glm::distance(place({1, 2, 3}), {0.001, 0.002, 0.003}) < 1e-15);
    file.set("space units", R"("cm" "cm" "cm")");
    CHECK(place({1, 2, 3}) == glm::dvec3(10, 20, 30));
    file.set("space units", R"("parsec" "parsec" "parsec")");
    CHECK(notes() == 2); // the name, and what it is taken for
    file.set("space units", "");
    CHECK(notes() == 1);

    file = NrrdText();
    file.set("space", "").set("space directions", "").set("space origin", "").set("space units", "");
    file.set("units", R"("mm" "mm" "mm")");
    CHECK(place({1, 2, 3}) == glm::dvec3(1, 2, 3));
    CHECK(notes() == 2); // how the patient lies, how far voxels are apart
    file.set("spacings", "0.5 2 4");
    CHECK(place({1, 2, 3}) == glm::dvec3(0.5, 4, 12));
    file.set("axis mins", "1 NaN 3").set("centers", "cell cell node");
    CHECK(place({0, 0, 0}) == glm::dvec3(1.25, 0, 3)); // a cell's middle is half a spacing further
    file.set("space", "LPS").set("space origin", "(7,8,9)");
    CHECK(place({0, 0, 0}) == glm::dvec3(-7, -8, 9));
}

TEST_CASE("axes of one value beside those of space are dropped, longer ones refused with their kind") {
    const test::VolumeFiles files{"a.nrrd"};
    NrrdText file;
    file.set("dimension", "4").set("sizes", "1 2 3 4").set("kinds", "vector domain domain domain");
    file.set("space directions", "none (2,0,0) (0,3,0) (0,0,4)");
    volume::Volume volume = files.good(file.bytes());
    CHECK(volume.size == glm::ivec3(2, 3, 4));
    CHECK(volume::value_at(volume, {1, 2, 3}) == 23.0);
    CHECK(volume::spacing_mm(volume.to_patient) == glm::dvec3(2, 3, 4));
    file.set("sizes", "2 3 4 1").set("kinds", "space space space time").set("space directions", "");
    CHECK(files.good(file.bytes()).size == glm::ivec3(2, 3, 4));
    file.set("kinds", "");
    CHECK(files.good(file.bytes()).size == glm::ivec3(2, 3, 4));

    file.set("sizes", "2 1 3 4").set("kinds", "3-color domain domain domain");
    CHECK(holds(files.refusal(file.bytes()), "each of its voxels holds 2 values (axis 1, of kind \"3-color\")"));
    file.set("space directions", "none (2,0,0) (0,3,0) (0,0,4)").set("kinds", "");
    CHECK(holds(files.refusal(file.bytes()), "each of its voxels holds 2 values (axis 1)"));
    file.set("space directions", "").set("sizes", "1 3 4 2").set("kinds", "domain domain domain list");
    CHECK(holds(files.refusal(file.bytes()), "it holds 2 volumes (axis 4, of kind \"list\")"));
    file.set("kinds", "");
    CHECK(holds(files.refusal(file.bytes()), "it holds 2 volumes"));

    NrrdText flat;
    flat.set("dimension", "2").set("sizes", "6 4").set("space directions", "(0,2,0) (0,0,3)").set("space units", "");
    volume = files.good(flat.bytes());
    CHECK(volume.size == glm::ivec3(6, 4, 1));
    CHECK(test::place(volume, {0, 0, 1}) == glm::dvec3(1, 0, 0)); // y x z
}

TEST_CASE("NRRD values in another file, behind lines and bytes that are not theirs") {
    const test::VolumeFiles files{"a.nhdr"};
    NrrdText file;
    const std::string values = file.values;
    const auto last = [&] {
        auto text = file.header();
        return volume::value_at(files.good(text), {1, 2, 3}); // a header alone needs no empty line
    };
    files.folder.write("b.raw", values);
    file.set("data file", "b.raw");
    CHECK(last() == 23.0);
    file.set("data file", "").set("datafile", (files.folder.path() / "b.raw").string());
    CHECK(last() == 23.0);
    files.folder.write("b.raw", "a line\nanother\n12345" + values);
    file.set("line skip", "2").set("byte skip", "5");
    CHECK(last() == 23.0);
    file.set("line skip", "").set("byte skip", "-1");
    CHECK(last() == 23.0);
    files.folder.write("b.raw", "a line\n" + test::compressed("12345" + values, test::Wrapper::kGzip));
    file.set("line skip", "1").set("byte skip", "5").set("encoding", "gzip"); // bytes are skipped after unpacking
    CHECK(last() == 23.0);
    // What looks like gzip is data where the header says so.
    file.set("line skip", "").set("byte skip", "").set("encoding", "raw");
    files.folder.write("b.raw", "\x1f\x8b" + values.substr(2));
    CHECK(last() == 23.0);

    file.set("datafile", "none.raw");
    CHECK(holds(files.refusal(file.bytes()), "there is no such file"));
    file.set("datafile", "/dev/zero");
    CHECK(holds(files.refusal(file.bytes()), "no regular file"));
    // A file of another folder is nobody's to make a volume of.
    const TemporaryFolder elsewhere;
    for (const std::string& name :
         {elsewhere.write("b.raw", values).string(), "../" + elsewhere.path().filename().string() + "/b.raw"}) {
        file.set("datafile", name);
        CHECK(holds(files.refusal(file.bytes()), "outside of the header's folder"));
    }
    file.set("datafile", "b%03d.raw 1 4 1");
    CHECK(holds(files.refusal(file.bytes()), "no such file"));
    file.set("datafile", "b.raw").set("byte skip", "1");
    CHECK_FALSE(files.read(file.bytes()));

    Job job;
    auto memory = io::ByteSource::of_memory(file.bytes(), "fuzz");
    REQUIRE(memory);
    const auto* format = io::recognised(memory->head(), "fuzz").volume;
    REQUIRE(format != nullptr);
    CHECK(holds(format->read(*memory, {}, job).error().what, "in another file"));
}

TEST_CASE("NRRD headers that make no sense are refused with a word") {
    const test::VolumeFiles files{"a.nrrd"};
    const auto with = [&](const char* field, const char* value) {
        return files.refusal(NrrdText().set(field, value).bytes());
    };
    CHECK(holds(with("type", ""), "\"type\" of its header is missing"));
    CHECK(holds(with("type", "word"), "not known: word"));
    CHECK(holds(with("type", "block"), "blocks"));
    CHECK(holds(with("dimension", "0"), "1 to 16"));
    CHECK(holds(with("dimension", "three"), "whole number"));
    CHECK(holds(with("sizes", "2 3"), "one for each axis"));
    CHECK(holds(with("sizes", "2 3 0"), "axis 3 is 0"));
    CHECK(holds(with("sizes", "2 -3 4"), "axis 2 is -3"));
    CHECK(holds(with("sizes", "2 3 99999999999999999999999"), "one for each axis"));
    CHECK(holds(with("encoding", ""), "missing"));
    CHECK(holds(with("encoding", "bzip2"), "encoded as bzip2"));
    CHECK(holds(with("encoding", "hex"), "encoded as hex"));
    CHECK(holds(with("encoding", "zip"), "not known"));
    CHECK(holds(with("space", "outer"), "not known: outer"));
    CHECK(holds(with("space directions", "(1,0,0) (0,1,0)"), "vector for each axis"));
    CHECK(holds(with("space directions", "(1,0,0) (0,1,0) (0,0,1) (0,0,1)"), "more vectors"));
    CHECK(holds(with("space directions", "(1,0,0) (0,1,0) (0,0,x)"), "no vector"));
    CHECK(holds(with("space directions", "(1,0,0) (0,1,0) (1,1,0)"), "one plane"));
    CHECK(holds(with("space directions", "(1,0,0) (0,1,0) (0,0,nan)"), "no number"));
    CHECK(holds(files.refusal(NrrdText().set("sizes", "1 1 1").set("space directions", "none none none").bytes()),
                "no axis of space"));
    CHECK(holds(with("space origin", "1 2 3"), "no vector"));
    CHECK(holds(with("space origin", "(1,2,1e9)"), "10 km"));
    CHECK(holds(with("kinds", "domain"), "one for each axis"));
    CHECK(holds(with("byte skip", "-2"), "makes no sense"));
    CHECK(holds(with("byte skip", "1"), "more than the file can hold"));
    CHECK(holds(with("line skip", "-1"), "negative"));
    CHECK(holds(with("line skip", "9"), "beyond the end"));
    CHECK(holds(files.refusal("NRRD0005\nno field\n\n"), "no field: no field"));
    CHECK(holds(files.refusal("NRRD0005\ntype: uchar"), "dimension"));
    NrrdText text;
    text.set("encoding", "text").values = "1 2 3 four" + std::string(40, ' ');
    CHECK(holds(files.refusal(text.bytes()), "four"));
    text.values = "1 2 3 256" + std::string(40, ' ');
    CHECK(holds(files.refusal(text.bytes()), "256"));
    text.values = "1 2 3" + std::string(50, ' ');
    CHECK(holds(files.refusal(text.bytes()), "ends before"));
    NrrdText shorts;
    shorts.set("type", "short").set("sizes", "2 3 2").set("endian", "middle");
    CHECK(holds(files.refusal(shorts.bytes()), "neither little nor big"));
    CHECK(files.good(shorts.set("endian", "").bytes()).notes.size() == 1);
}

TEST_CASE("an NRRD file that claims much, is cut short or damaged is refused" * doctest::test_suite("slow")) {
    const test::VolumeFiles files{"a.nrrd"};
    NrrdText file;
    file.set("space directions", "(1e-3,0,0) (0,1e-3,0) (0,0,1e-3)").set("sizes", "10000 10000 10000");
    for (const char* encoding : {"raw", "gzip", "text"})
        CHECK(holds(files.refusal(file.set("encoding", encoding).bytes()), "more than the file can hold"));
    file.set("sizes", "2000000000 2000000000 2000000000");
    CHECK(holds(files.refusal(file.bytes()), "more than the file can hold"));
    NrrdText zeros;
    zeros.set("sizes", "256 256 255").set("encoding", "gzip");
    zeros.values = test::compressed(std::string(std::size_t{256} * 256 * 255, '\0'), test::Wrapper::kGzip);
    CHECK(holds(files.refusal(zeros.bytes(), 1.0), "take 2 MB of memory"));

    std::mt19937 random(5);
    std::string noise(6000, '\0');
    for (char& byte : noise) byte = static_cast<char>(random());
    NrrdText whole;
    whole.set("sizes", "20 15 20");
    for (const bool gzip : {false, true}) {
        whole.set("encoding", gzip ? "gzip" : "raw");
        whole.values = gzip ? test::compressed(noise, test::Wrapper::kGzip) : noise;
        const std::string bytes = whole.bytes();
        CHECK(files.read(bytes));
        for (std::size_t n = 0; n < 20; ++n) CHECK_FALSE(files.read(bytes.substr(0, bytes.size() * n / 20)));
        CHECK_FALSE(files.read(bytes.substr(0, bytes.size() - 1)));
        for (int n = 0; gzip && n < 100; ++n) { // a checksum tells
            std::string damaged = bytes;
            const std::size_t at = whole.header().size() + 11 + random() % 5000;
            damaged[at] = static_cast<char>(damaged[at] ^ (1 << random() % 8));
            CHECK_FALSE(files.read(damaged));
        }
    }
    for (int n = 0; n < 2000; ++n) { // ends in a volume or in an error
        std::string bytes = NrrdText().set("encoding", n % 2 == 0 ? "raw" : "text").bytes();
        for (unsigned hits = 1 + random() % 4; hits > 0; --hits)
            bytes[8 + random() % (bytes.size() - 8)] = "0123456789 ()-.,:nae\n"[random() % 21];
        const auto volume = files.read(bytes, 1e9);
        if (!volume) CHECK_FALSE(volume.error().what.empty());
    }
}
