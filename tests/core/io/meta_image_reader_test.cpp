// MetaImage as MetaIO's documentation has it: every type, byte order, encoding and way to say where voxels lie; and
// what is refused.
#include "core/io/volumes/volume_file.h"
#include "tests/support/volume_files.h"

#include <doctest/doctest.h>
#include <glm/geometric.hpp>
#include <random>

using namespace ramus;
using test::holds;

namespace {

// A header of 2 x 3 x 4 bytes, of which fields can be changed, added and, by an empty value, left out.
struct MetaText {
    std::vector<std::pair<std::string, std::string>> fields{
        {"ObjectType", "Image"},      {"NDims", "3"},
        {"BinaryData", "True"},       {"TransformMatrix", "1 0 0 0 1 0 0 0 1"},
        {"Offset", "0 0 0"},          {"ElementSpacing", "1 1 1"},
        {"DimSize", "2 3 4"},         {"DistanceUnits", "mm"},
        {"ElementType", "MET_UCHAR"},
    };
    std::string file = "LOCAL", values;

    MetaText() {
        for (char n = 0; n < 24; ++n) values += n;
    }
    MetaText& set(const std::string& field, const std::string& value) {
        const auto known = std::ranges::find(fields, field, &std::pair<std::string, std::string>::first);
        if (known == fields.end())
            fields.emplace_back(field, value);
        else
            known->second = value;
        return *this;
    }
    [[nodiscard]] std::string header() const {
        std::string text;
        for (const auto& [field, value] : fields)
            if (!value.empty()) text.append(field).append(" = ").append(value).append("\n");
        return text + "ElementDataFile = " + file + "\n";
    }
    [[nodiscard]] std::string bytes() const { return header() + values; }
};

template <class T> void check_meta_type(const std::vector<const char*>& words, const std::vector<T>& values) {
    const test::VolumeFiles files{"a.mha"};
    std::string text;
    for (const T value : values) text += " " + std::to_string(value);
    const auto check = [&](const MetaText& file) {
        const volume::Volume volume = files.good(file.bytes());
        REQUIRE(volume::voxel_count(volume.size) == values.size());
        for (std::size_t n = 0; n < values.size(); ++n)
            CHECK(volume::value_at(volume, {static_cast<int>(n), 0, 0}) == static_cast<double>(values[n]));
    };
    for (const char* word : words) {
        CAPTURE(word);
        MetaText file;
        file.set("ElementType", word).set("DimSize", std::to_string(values.size()) + " 1 1");
        for (const bool big : {false, true}) {
            const std::string bytes = test::bytes_of(values, big);
            file.set(sizeof(T) % 4 == 0 ? "ElementByteOrderMSB" : "BinaryDataByteOrderMSB", big ? "True" : "False");
            file.values = bytes;
            check(file.set("CompressedData", ""));
            for (const test::Wrapper wrapper : {test::Wrapper::kZlib, test::Wrapper::kGzip}) {
                file.values = test::compressed(bytes, wrapper);
                check(file.set("CompressedData", "True"));
            }
        }
        file.set("BinaryData", "False").set("CompressedData", "False").values = text;
        check(file);
    }
}

} // namespace

TEST_CASE("MetaImage values of every type, byte order and encoding are read as they are") {
    check_meta_type<std::int8_t>({"MET_CHAR"}, {0, -128, 127, 5});
    check_meta_type<std::uint8_t>({"MET_UCHAR"}, {0, 1, 200, 255});
    check_meta_type<std::int16_t>({"MET_SHORT"}, {0, -1024, 3071, 1});
    check_meta_type<std::uint16_t>({"MET_USHORT"}, {0, 1, 65535, 300});
    check_meta_type<std::int32_t>({"MET_INT", "MET_LONG"}, {0, -2147483647 - 1, 2147483647, 70000});
    check_meta_type<std::uint32_t>({"MET_UINT", "MET_ULONG"}, {0, 1, 2147483647, 70000});
    check_meta_type<std::int64_t>({"MET_LONG_LONG"}, {0, -70000, 2147483647, 1});
    check_meta_type<std::uint64_t>({"MET_ULONG_LONG"}, {0, 1, 2147483647, 70000});
    check_meta_type<float>({"MET_FLOAT"}, {0.0F, -1.5F, 1e6F, 0.25F});
    check_meta_type<double>({"MET_DOUBLE"}, {0.0, -1.5, 1e6, 0.25});
}

TEST_CASE("where the voxels of MetaImage lie: LPS, under every name that the fields have") {
    const test::VolumeFiles files{"a.mha"};
    for (const char* matrix : {"TransformMatrix", "Rotation", "Orientation"}) {
        for (const char* offset : {"Offset", "Position", "Origin"}) {
            for (const char* spacing : {"ElementSpacing", "ElementSize"}) {
                MetaText file;
                file.set("TransformMatrix", "").set("Offset", "").set("ElementSpacing", "");
                // x leads to y, y to z, z to x; each axis is three numbers in a row.
                file.set(matrix, "0 1 0 0 0 1 1 0 0").set(offset, "10 20 30").set(spacing, "2 3 4");
                const volume::Volume volume = files.good(file.bytes());
                CHECK(test::place(volume, {1, 2, 3}) == glm::dvec3(-22, -22, 36)); // 10 + 12, 20 + 2, 30 + 6
                CHECK(volume.notes.empty());
            }
        }
    }
    const auto notes = [&](MetaText& file) { return files.good(file.bytes()).notes; };
    const auto lies = [&](MetaText& file) { return volume::orientation(files.good(file.bytes()).to_patient); };
    MetaText file;
    CHECK(lies(file) == "LPS");
    CHECK(notes(file.set("AnatomicalOrientation", "RAI")).empty()); // from right, anterior, inferior
    CHECK(notes(file.set("AnatomicalOrientation", "???")).empty());
    CHECK(holds(notes(file.set("AnatomicalOrientation", "LPI")).at(0), "contradicts"));
    CHECK(lies(file) == "LPS");
    CHECK(lies(file.set("TransformMatrix", "")) == "RAS"); // letters alone
    CHECK(notes(file).empty());
    CHECK(lies(file.set("AnatomicalOrientation", "SPL")) == "IAR");
    CHECK(lies(file.set("AnatomicalOrientation", "RRI")) == "LPS"); // no such axes
    CHECK(holds(notes(file).at(0), "how the patient lies"));

    file = MetaText();
    CHECK(test::place(files.good(file.set("DistanceUnits", "cm").bytes()), {1, 0, 0}).x == -10.0);
    CHECK(holds(notes(file.set("DistanceUnits", "?")).at(0), "no unit"));
    CHECK(notes(file.set("ElementSpacing", "")).size() == 2);

    MetaText flat;
    flat.set("NDims", "2").set("DimSize", "6 4").set("TransformMatrix", "0 1 1 0").set("Offset", "5 6");
    flat.set("ElementSpacing", "2 3");
    const volume::Volume volume = files.good(flat.bytes());
    CHECK(volume.size == glm::ivec3(6, 4, 1));
    CHECK(test::place(volume, {1, 1, 0}) == glm::dvec3(-8, -8, 0));
    MetaText series;
    series.set("NDims", "4").set("DimSize", "2 3 4 1").set("Offset", "0 0 0 0").set("ElementSpacing", "1 1 1 1");
    series.set("TransformMatrix", "1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1");
    CHECK(files.good(series.bytes()).size == glm::ivec3(2, 3, 4));
    CHECK(holds(files.refusal(series.set("DimSize", "2 3 2 2").bytes()), "it holds 2 volumes, along axis 4"));
}

TEST_CASE("MetaImage values in another file, behind a header of its own") {
    const test::VolumeFiles files{"a.mhd"};
    MetaText file;
    const std::string values = std::exchange(file.values, "");
    const auto last = [&] { return volume::value_at(files.good(file.bytes()), {1, 2, 3}); };
    file.file = "b.raw";
    files.folder.write("b.raw", values);
    CHECK(last() == 23.0);
    files.folder.write("b.raw", "header" + values);
    file.set("HeaderSize", "6");
    CHECK(last() == 23.0);
    file.set("HeaderSize", "-1");
    CHECK(last() == 23.0);
    files.folder.write("b.zraw", "header" + test::compressed(values, test::Wrapper::kZlib));
    file.set("HeaderSize", "6").set("CompressedData", "True").file = "b.zraw";
    CHECK(last() == 23.0);
    CHECK(holds(files.refusal(file.set("HeaderSize", "-1").bytes()), "makes no sense"));
    CHECK(holds(files.refusal(file.set("HeaderSize", "999999999").bytes()), "beyond the end"));
    file.file = "none.raw";
    CHECK(holds(files.refusal(file.bytes()), "no such file"));
    file.file = ".";
    CHECK(holds(files.refusal(file.bytes()), "no regular file"));
    file.file = "LIST";
    CHECK(holds(files.refusal(file.bytes()), "lists no file"));
    file.file = "slice%03d.raw 1 4 1";
    CHECK(holds(files.refusal(file.bytes()), "several files"));
}

TEST_CASE("MetaImage slope and intercept, and headers that make no sense") {
    const test::VolumeFiles files{"a.mha"};
    MetaText scaled;
    scaled.set("ElementToIntensityFunctionSlope", "2").set("ElementToIntensityFunctionOffset", "-1000");
    CHECK(volume::value_at(files.good(scaled.bytes()), {1, 2, 3}) == -954.0);

    const auto with = [&](const char* field, const char* value) {
        return files.refusal(MetaText().set(field, value).bytes());
    };
    CHECK(holds(with("ObjectType", "Landmark"), "another kind: Landmark"));
    CHECK(holds(with("NDims", "0"), "1 to 10"));
    CHECK(holds(with("DimSize", ""), "one for each axis"));
    CHECK(holds(with("DimSize", "2 3 4 5"), "one for each axis"));
    CHECK(holds(with("DimSize", "2 3 -4"), "axis 3 is -4"));
    CHECK(holds(with("ElementType", ""), "missing"));
    CHECK(holds(with("ElementType", "MET_FLOAT_ARRAY"), "not known: MET_FLOAT_ARRAY"));
    CHECK(holds(with("ElementNumberOfChannels", "3"), "holds 3 values"));
    CHECK(holds(with("TransformMatrix", "1 0 0 0 1 0"), "9 numbers"));
    CHECK(holds(with("TransformMatrix", "1 0 0 0 1 0 1 1 0"), "one plane"));
    CHECK(holds(with("ElementSpacing", "1 1 0"), "one plane"));
    CHECK(holds(with("ElementSpacing", "1 1 mm"), "3 numbers"));
    CHECK(holds(with("Offset", "0 0 nan"), "no number"));
    CHECK(holds(with("Offset", "0 0 1e9"), "10 km"));
    CHECK(holds(with("ElementToIntensityFunctionSlope", "nan"), "finite"));
    CHECK(holds(files.refusal("ObjectType = Image\nNDims = 3\n"), "ElementDataFile"));
    CHECK(holds(files.refusal("ObjectType = Image\nno field\n"), "no field: no field"));
}

TEST_CASE("a MetaImage file that claims much, is cut short or damaged is refused" * doctest::test_suite("slow")) {
    const test::VolumeFiles files{"a.mha"};
    MetaText file;
    file.set("ElementSpacing", "1e-3 1e-3 1e-3").set("DimSize", "10000 10000 10000");
    CHECK(holds(files.refusal(file.bytes()), "more than the file can hold"));
    CHECK(holds(files.refusal(file.set("CompressedData", "True").bytes()), "more than the file can hold"));
    CHECK(holds(files.refusal(file.set("DimSize", "2000000000 2000000000 2000000000").bytes()), "more than the file"));

    std::mt19937 random(6);
    std::string noise(6000, '\0');
    for (char& byte : noise) byte = static_cast<char>(random());
    MetaText whole;
    whole.set("DimSize", "20 15 20");
    for (const bool packed : {false, true}) {
        whole.set("CompressedData", packed ? "True" : "False");
        whole.values = packed ? test::compressed(noise, test::Wrapper::kZlib) : noise;
        const std::string bytes = whole.bytes();
        CHECK(files.read(bytes));
        for (std::size_t n = 0; n < 20; ++n) CHECK_FALSE(files.read(bytes.substr(0, bytes.size() * n / 20)));
        CHECK_FALSE(files.read(bytes.substr(0, bytes.size() - 1)));
    }
    for (int n = 0; n < 2000; ++n) { // ends in a volume or in an error
        std::string bytes = MetaText().set("BinaryData", n % 2 == 0 ? "True" : "False").bytes();
        for (unsigned hits = 1 + random() % 4; hits > 0; --hits)
            bytes[12 + random() % (bytes.size() - 12)] = "0123456789 MTF=-.nae\n"[random() % 21];
        const auto volume = files.read(bytes, 1e9);
        if (!volume) CHECK_FALSE(volume.error().what.empty());
    }
}
