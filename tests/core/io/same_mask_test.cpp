// One mask, written in every format that is read, lies at the same places of the patient, and on the tree that it is
// of.
#include "core/io/trees/tree_file.h"
#include "core/io/volumes/dicom/dicom_reader.h"
#include "core/io/volumes/volume_file.h"
#include "core/volume/label_counts.h"
#include "tests/support/dicom_file.h"
#include "tests/support/nifti_file.h"
#include "tests/support/volume_files.h"

#include <cmath>
#include <doctest/doctest.h>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

using namespace ramus;
using test::DicomElements;

namespace {

// A straight vessel, in RAS mm.
const glm::dvec3 kFrom(1.0, -25.5, 2.0), kTo(3.5, -29.5, 15.0);
constexpr double kRadius = 3.0;

double distance_to_vessel(const glm::dvec3& p) {
    const glm::dvec3 along = kTo - kFrom;
    const double t = std::clamp(glm::dot(p - kFrom, along) / glm::dot(along, along), 0.0, 1.0);
    return glm::distance(p, kFrom + t * along);
}

// Oblique and anisotropic; LPS, as images are made. Column n: direction of axis n.
struct ObliqueMask {
    glm::ivec3 size{14, 12, 9};
    glm::dvec3 spacing{1.0, 1.25, 2.5}, origin{-6.0, 20.0, -2.0};
    glm::dmat3 axes{1.0};
    std::vector<std::uint8_t> labels; // 1: the lower half of the vessel, 2: the upper

    ObliqueMask() {
        const double turn = 0.3, lean = 0.2;
        const glm::dvec3 x(std::cos(turn), std::sin(turn), 0.0);
        const glm::dvec3 y(-std::sin(turn) * std::cos(lean), std::cos(turn) * std::cos(lean), std::sin(lean));
        axes = glm::dmat3(x, y, glm::cross(x, y));
        for (int k = 0; k < size.z; ++k)
            for (int j = 0; j < size.y; ++j)
                for (int i = 0; i < size.x; ++i) {
                    const glm::dvec3 at = ras({i, j, k});
                    labels.push_back(distance_to_vessel(at) > kRadius ? 0 : at.z < 9.0 ? 1 : 2);
                }
    }
    [[nodiscard]] glm::dvec3 lps(const glm::dvec3& voxel) const { return origin + axes * (spacing * voxel); }
    [[nodiscard]] glm::dvec3 ras(const glm::dvec3& voxel) const { return lps(voxel) * glm::dvec3(-1, -1, 1); }
    [[nodiscard]] std::string bytes() const { return {labels.begin(), labels.end()}; }
};

std::string numbers(const glm::dvec3& v, const char* between) {
    const auto text = [](double value) {
        std::array<char, 40> out{};
        std::snprintf(out.data(), out.size(), "%.17g", value);
        return std::string(out.data());
    };
    return text(v.x) + between + text(v.y) + between + text(v.z);
}

std::string as_nifti(const ObliqueMask& mask) {
    test::NiftiFile file;
    file.dim = {3, mask.size.x, mask.size.y, mask.size.z, 1, 1, 1, 1};
    file.version = 2; // in double precision
    for (int row = 0; row < 3; ++row) {
        const double sign = row < 2 ? -1.0 : 1.0;
        for (int column = 0; column < 3; ++column)
            file.rows[static_cast<std::size_t>(4 * row + column)] =
                sign * mask.axes[column][row] * mask.spacing[column];
        file.rows[static_cast<std::size_t>(4 * row + 3)] = sign * mask.origin[row];
    }
    file.put(mask.labels);
    return file.bytes();
}

std::string as_nrrd(const ObliqueMask& mask, bool lps) {
    const glm::dvec3 signs = lps ? glm::dvec3(1) : glm::dvec3(-1, -1, 1);
    std::string text = "NRRD0004\ntype: uchar\ndimension: 3\nencoding: raw\nsizes: " + std::to_string(mask.size.x) +
                       " " + std::to_string(mask.size.y) + " " + std::to_string(mask.size.z) +
                       "\nspace: " + (lps ? "left-posterior-superior" : "right-anterior-superior") +
                       "\nspace directions:";
    for (int n = 0; n < 3; ++n) text += " (" + numbers(signs * mask.axes[n] * mask.spacing[n], ",") + ")";
    text += "\nspace origin: (" + numbers(signs * mask.origin, ",") + ")\nspace units: \"mm\" \"mm\" \"mm\"\n";
    return text + "Segment0_LabelValue:=2\nSegment0_Name:=Upper\nSegment1_LabelValue:=1\nSegment1_Name:=Lower\n\n" +
           mask.bytes();
}

std::string as_meta_image(const ObliqueMask& mask) {
    std::string text = "ObjectType = Image\nNDims = 3\nBinaryData = True\nTransformMatrix =";
    for (int n = 0; n < 3; ++n) text += " " + numbers(mask.axes[n], " ");
    text += "\nOffset = " + numbers(mask.origin, " ") + "\nElementSpacing = " + numbers(mask.spacing, " ") +
            "\nDimSize = " + numbers(mask.size, " ") + "\nDistanceUnits = mm\nElementType = MET_UCHAR\n";
    return text + "ElementDataFile = LOCAL\n" + mask.bytes();
}

enum class Pixels { kBits, kFractions, kLabels };

DicomElements frame_of(const ObliqueMask& mask, int z, int segment) {
    const glm::dvec3 at = mask.lps({0, 0, z});
    DicomElements frame;
    frame.items(0x00209113, {DicomElements().decimals(0x00200032, {at.x, at.y, at.z})});
    if (segment > 0) frame.items(0x0062000a, {DicomElements().number(0x0062000b, static_cast<std::uint16_t>(segment))});
    return frame;
}

// Frames as segmentations have them: by segment, and none where a slice is empty.
DicomElements as_segmentation(const ObliqueMask& mask, Pixels pixels) {
    const std::size_t plane = static_cast<std::size_t>(mask.size.x) * static_cast<std::size_t>(mask.size.y);
    std::vector<DicomElements> frames;
    std::vector<std::uint8_t> values;
    for (const int segment : {2, 1}) {
        if (pixels == Pixels::kLabels && segment == 1) break;
        for (int z = 0; z < mask.size.z; ++z) {
            const auto* begin = mask.labels.data() + static_cast<std::size_t>(z) * plane;
            const auto counts = [&](std::uint8_t label) {
                return pixels == Pixels::kLabels ? label != 0 : label == segment;
            };
            if (std::none_of(begin, begin + plane, counts)) continue;
            frames.push_back(frame_of(mask, z, pixels == Pixels::kLabels ? 0 : segment));
            for (std::size_t n = 0; n < plane; ++n)
                values.push_back(pixels == Pixels::kLabels      ? begin[n]
                                 : pixels == Pixels::kFractions ? (counts(begin[n]) ? 180 : 90)
                                                                : (counts(begin[n]) ? 1 : 0));
        }
    }
    const int bits = pixels == Pixels::kBits ? 1 : 8;
    if (bits == 1) {
        std::vector<std::uint8_t> packed((values.size() + 7) / 8);
        for (std::size_t n = 0; n < values.size(); ++n)
            packed[n / 8] = static_cast<std::uint8_t>(packed[n / 8] | values[n] << n % 8);
        values = packed;
    }
    DicomElements shared;
    shared.items(0x00209116, {DicomElements().decimals(0x00200037, {mask.axes[0].x, mask.axes[0].y, mask.axes[0].z,
                                                                    mask.axes[1].x, mask.axes[1].y, mask.axes[1].z})});
    shared.items(0x00289110, {DicomElements()
                                  .decimals(0x00280030, {mask.spacing.y, mask.spacing.x})
                                  .decimals(0x00180088, {mask.spacing.z})});
    const auto segment = [](std::uint16_t number, const char* name) {
        return DicomElements().number(0x00620004, number).text(0x00620005, "LO", name);
    };
    DicomElements file;
    const bool labels = pixels == Pixels::kLabels;
    file.text(0x00080016, "UI", labels ? "1.2.840.10008.5.1.4.1.1.66.7" : "1.2.840.10008.5.1.4.1.1.66.4");
    file.text(0x00080018, "UI", "1.2.3.9").text(0x00080060, "CS", "SEG").text(0x0020000e, "UI", "1.2.3.5");
    file.number(0x00280002, 1).text(0x00280004, "CS", "MONOCHROME2");
    file.text(0x00280008, "IS", std::to_string(frames.size()));
    file.number(0x00280010, static_cast<std::uint16_t>(mask.size.y));
    file.number(0x00280011, static_cast<std::uint16_t>(mask.size.x));
    file.number(0x00280100, static_cast<std::uint16_t>(bits)).number(0x00280101, static_cast<std::uint16_t>(bits));
    file.number(0x00280102, static_cast<std::uint16_t>(bits - 1)).number(0x00280103, 0);
    file.text(0x00620001, "CS", labels ? "LABELMAP" : bits == 1 ? "BINARY" : "FRACTIONAL");
    file.items(0x00620002, {segment(2, "Upper"), segment(1, "Lower")}).number(0x0062000e, 255);
    file.items(0x52009229, {shared}).items(0x52009230, frames);
    file.pixels(std::string(values.begin(), values.end()), 1);
    return file;
}

volume::Volume read(const std::string& name, const std::string& bytes) { return test::VolumeFiles{name}.good(bytes); }

} // namespace

TEST_CASE("one mask in four formats, and the tree it is of, lie at the same places") {
    const ObliqueMask mask;
    const TemporaryFolder folder;
    const auto tree = io::read_tree(
        folder.write("a.swc", "1 1 " + numbers(kFrom, " ") + " 3 -1\n2 1 " + numbers(kTo, " ") + " 3 1\n"));
    REQUIRE(tree);
    const std::vector<std::pair<volume::Volume, bool>> volumes = {
        // whether it names its labels
        {read("a.nii", as_nifti(mask)), false},
        {read("ras.nrrd", as_nrrd(mask, false)), true},
        {read("lps.nrrd", as_nrrd(mask, true)), true},
        {read("a.mha", as_meta_image(mask)), false},
        {read("bits.dcm", as_segmentation(mask, Pixels::kBits).file()), true},
        {read("fractions.dcm", as_segmentation(mask, Pixels::kFractions).file()), true},
        {read("labels.dcm", as_segmentation(mask, Pixels::kLabels).file()), true}};
    for (const auto& each : volumes) {
        const volume::Volume& volume = each.first;
        const bool named = each.second;
        CAPTURE(volume.type);
        // Segmentations leave empty slices out at both ends.
        const glm::dvec3 shift = glm::inverse(glm::dmat3(mask.axes)) *
                                 (test::place(volume, {0, 0, 0}) * glm::dvec3(-1, -1, 1) - mask.origin) / mask.spacing;
        CHECK(glm::length(shift - glm::round(shift)) < 1e-6); // DICOM's numbers have 16 letters
        const glm::ivec3 first(glm::round(shift));
        CHECK((first.x == 0 && first.y == 0));
        std::size_t inside = 0;
        for (int z = 0; z < volume.size.z; ++z)
            for (int y = 0; y < mask.size.y; ++y)
                for (int x = 0; x < mask.size.x; ++x) {
                    const glm::ivec3 there = glm::ivec3(x, y, z) + first;
                    const auto at = static_cast<std::size_t>(there.x + mask.size.x * (there.y + mask.size.y * there.z));
                    const glm::dvec3 place = test::place(volume, {x, y, z});
                    REQUIRE(glm::distance(place, mask.ras(there)) < 1e-6);
                    REQUIRE(volume::value_at(volume, {x, y, z}) == mask.labels[at]);
                    // Against the tree that was read.
                    const glm::dvec3 along = tree->points[1].position - tree->points[0].position;
                    const glm::dvec3 from = place - tree->points[0].position;
                    const double t = std::clamp(glm::dot(from, along) / glm::dot(along, along), 0.0, 1.0);
                    const double distance = glm::length(from - t * along);
                    if (std::abs(distance - kRadius) > 1e-6)
                        REQUIRE((distance < tree->points[0].radius) == (mask.labels[at] != 0));
                    inside += mask.labels[at] != 0 ? 1 : 0;
                }
        CHECK(inside > 100);
        CHECK(inside == static_cast<std::size_t>(std::ranges::count_if(mask.labels, [](auto l) { return l != 0; })));
        if (named) CHECK(volume.label_names == std::vector<volume::LabelName>{{1, "Lower"}, {2, "Upper"}});
    }
}

TEST_CASE("segmentations with empty slices, overlaps, and damage") {
    ObliqueMask mask;
    const std::size_t plane = static_cast<std::size_t>(mask.size.x) * static_cast<std::size_t>(mask.size.y);
    std::fill_n(mask.labels.begin() + static_cast<std::ptrdiff_t>(4 * plane), plane, std::uint8_t{0});
    const volume::Volume gap = read("a.dcm", as_segmentation(mask, Pixels::kBits).file());
    CHECK(gap.notes.empty());
    bool empty = false;
    for (int z = 0; z < gap.size.z; ++z) {
        double sum = 0.0;
        for (int y = 0; y < gap.size.y; ++y)
            for (int x = 0; x < gap.size.x; ++x) sum += volume::value_at(gap, {x, y, z});
        empty |= sum == 0.0;
    }
    CHECK(empty);

    const ObliqueMask whole;
    const std::string bits = as_segmentation(whole, Pixels::kBits).file();
    const auto refusal = [](const DicomElements& elements) {
        return test::VolumeFiles{"a.dcm"}.refusal(elements.file());
    };
    const auto of = [&](Pixels pixels) { return as_segmentation(whole, pixels); };
    CHECK(test::holds(refusal(of(Pixels::kBits).text(0x00620001, "CS", "SURFACE")), "unknown kind"));
    CHECK(test::holds(refusal(of(Pixels::kBits).text(0x00280008, "IS", "3")), "other frames"));
    CHECK(test::holds(refusal(of(Pixels::kBits).number(0x00280010, 60000)), "more pixels than"));
    CHECK(test::holds(refusal(of(Pixels::kBits).pixels("abcd", 1)), "more pixels than"));
    std::vector<DicomElements> frames = {frame_of(whole, 0, 1), frame_of(whole, 0, 2)};
    DicomElements both = of(Pixels::kFractions);
    both.text(0x00280008, "IS", "2").items(0x52009230, frames);
    both.pixels(std::string(2 * plane, '\xff'), 1);
    const volume::Volume overlap = read("a.dcm", both.file());
    CHECK(overlap.size.z == 1);
    CHECK(volume::value_at(overlap, {3, 3, 0}) == 2);
    const std::size_t voxels = 168; // of a slice
    CHECK(volume::label_counts(overlap) == std::vector<volume::LabelCount>{{1, voxels}, {2, voxels}});
    CHECK(volume::shared_counts(overlap) == std::vector<volume::SharedCount>{{{1, 2}, voxels}});
    // A frame a kilometre away claims more slices than there can be.
    const glm::dvec3 far = whole.lps({0, 0, 400'000});
    frames[1].items(0x00209113, {DicomElements().decimals(0x00200032, {far.x, far.y, far.z})});
    CHECK(test::holds(refusal(both.items(0x52009230, frames)), "further apart"));
    const glm::dvec3 between = whole.lps({0, 0, 2.5});
    frames = {frame_of(whole, 0, 1), frame_of(whole, 1, 1), frame_of(whole, 2, 1)};
    frames[2].items(0x00209113, {DicomElements().decimals(0x00200032, {between.x, between.y + 2.0, between.z})});
    both.text(0x00280008, "IS", "3").pixels(std::string(3 * plane, '\xff'), 1);
    CHECK(test::holds(refusal(both.items(0x52009230, frames)), "even steps"));
    for (std::size_t n = 1; n < 20; ++n) {
        Job job;
        auto source = io::ByteSource::of_memory(std::string_view(bits).substr(0, bits.size() * n / 20), "cut");
        REQUIRE(source);
        CHECK_FALSE(io::read_dicom(*source, {}, job));
    }
}

TEST_CASE("units of volumes: what the file says, what a person says, and a suspicion") {
    const auto read_as = [](const std::string& fields, const char* unit) {
        const TemporaryFolder folder;
        Job job;
        const std::string text = "ObjectType = Image\nNDims = 3\nDimSize = 4 4 4\nTransformMatrix = 1 0 0 0 1 0 0 0 1\n"
                                 "ElementType = MET_UCHAR\n" +
                                 fields + "ElementDataFile = LOCAL\n" + std::string(64, 'a');
        io::ReadVolumeOptions options;
        if (unit != nullptr) options.unit = io::length_unit(unit);
        auto volume = io::read_volume(folder.write("a.mha", text), options, job);
        REQUIRE_MESSAGE(volume, (volume ? "" : volume.error().message()));
        return *volume;
    };
    const std::string bare = "ElementSpacing = 2 3 4\nOffset = 10 20 30\n", said = bare + "DistanceUnits = um\n";
    CHECK(test::place(read_as(bare, nullptr), {1, 1, 1}) == glm::dvec3(-12, -23, 34));
    CHECK(read_as(bare, nullptr).suspicions.empty());
    CHECK(test::place(read_as(bare, "cm"), {1, 1, 1}) == glm::dvec3(-120, -230, 340));
    CHECK(test::holds(read_as(bare, "cm").notes.at(0), "in cm as asked for; the file does not say"));
    CHECK(test::place(read_as(bare, "1x2x3"), {1, 1, 1}) == glm::dvec3(-12, -46, 102));
    CHECK(glm::distance(test::place(read_as(said, nullptr), {1, 1, 1}), glm::dvec3(-12, -23, 34) * 1e-3) < 1e-12);
    CHECK(read_as(said, nullptr).suspicions.empty()); // it states a unit
    CHECK(read_as(said, "um").notes.empty());
    CHECK(test::holds(read_as(said, "cm").notes.at(0), "in cm as asked for; the file says um"));
    CHECK(glm::distance(test::place(read_as(said, "cm"), {1, 1, 1}), glm::dvec3(-120, -230, 340)) < 1e-9);

    const auto word = [&](double spacing, int size) {
        const TemporaryFolder folder;
        const std::string n = std::to_string(size);
        std::string text = "ObjectType = Image\nNDims = 3\nDimSize = " + n + " 1 1\nElementSpacing = ";
        text += numbers(glm::dvec3(spacing), " ") + "\nElementType = MET_UCHAR\nElementDataFile = LOCAL\n";
        Job job;
        const auto path = folder.write("a.mha", text + std::string(static_cast<std::size_t>(size), 'a'));
        const auto volume = io::read_volume(path, {}, job);
        REQUIRE(volume);
        return volume->suspicions.empty() ? std::string() : volume->suspicions.front();
    };
    CHECK(test::holds(word(0.04, 256), "--units cm"));
    CHECK(test::holds(word(0.0004, 512), "--units m"));
    CHECK(test::holds(word(10.0, 512), "--units um"));
    CHECK(word(0.7, 512).empty());
}
