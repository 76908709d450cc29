#include "core/io/volumes/meta_image_reader.h"

#include "core/io/length_unit.h"
#include "core/io/volumes/header_text.h"
#include "core/io/volumes/value_files.h"
#include "core/io/volumes/voxel_data.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <string>
#include <utility>

namespace ramus::io {

namespace {

struct MetaType {
    std::string_view word;
    VoxelType number;
};
// "Long" has 4 bytes in this format on all machines.
constexpr std::array<MetaType, 13> kMetaTypes = {{{"MET_CHAR", VoxelType::kInt8},
                                                  {"MET_ASCII_CHAR", VoxelType::kInt8},
                                                  {"MET_UCHAR", VoxelType::kUint8},
                                                  {"MET_SHORT", VoxelType::kInt16},
                                                  {"MET_USHORT", VoxelType::kUint16},
                                                  {"MET_INT", VoxelType::kInt32},
                                                  {"MET_UINT", VoxelType::kUint32},
                                                  {"MET_LONG", VoxelType::kInt32},
                                                  {"MET_ULONG", VoxelType::kUint32},
                                                  {"MET_LONG_LONG", VoxelType::kInt64},
                                                  {"MET_ULONG_LONG", VoxelType::kUint64},
                                                  {"MET_FLOAT", VoxelType::kFloat32},
                                                  {"MET_DOUBLE", VoxelType::kFloat64}}};

// The fields up to ElementDataFile, after which the values begin.
Result<HeaderText> meta_header(ByteSource& source) {
    HeaderText header{source.name(), {}};
    std::string line;
    for (std::size_t bytes = 0; !header.fields.contains("ElementDataFile"); bytes += line.size()) {
        RAMUS_TRY(more, source.read_line(line, kMostHeaderBytes));
        if (!more) return header.refused("ElementDataFile", "is missing");
        if (bytes > kMostHeaderBytes)
            return fail("its header has more than 16 MB", source.name(), "write the file again");
        if (trimmed(line).empty()) continue;
        const std::size_t equals = line.find('=');
        if (equals == std::string::npos)
            return fail("its header has a line that is no field: " + line.substr(0, 40), source.name(),
                        "correct the header, or write the file again");
        const std::string_view text = line;
        header.fields[std::string(trimmed(text.substr(0, equals)))] = trimmed(text.substr(equals + 1));
    }
    return header;
}

// Whether a field is "True". False if it is missing.
bool is_true(const HeaderText& header, std::initializer_list<const char*> names) {
    const std::string* text = header.find(names);
    return text != nullptr && (text->starts_with('T') || text->starts_with('t') || *text == "1");
}

Result<VoxelType> meta_type(const HeaderText& header) {
    if (const std::string* kind = header.find({"ObjectType"}); kind != nullptr && *kind != "Image")
        return fail("this is a MetaIO object of another kind: " + *kind, header.file, "name an image");
    RAMUS_TRY(channels, header.whole_number({"ElementNumberOfChannels"}));
    if (channels.value_or(1) != 1)
        return fail("each of its voxels holds " + std::to_string(*channels) + " values", header.file,
                    "write the one that is meant to a file of its own");
    const std::string* text = header.find({"ElementType"});
    if (text == nullptr) return header.refused("ElementType", "is missing");
    const auto* known = std::ranges::find(kMetaTypes, std::string_view(*text), &MetaType::word);
    if (known == kMetaTypes.end()) return header.refused("ElementType", "is not known: " + *text);
    return known->number;
}

Result<std::vector<std::int64_t>> meta_extents(const HeaderText& header) {
    RAMUS_TRY(dimensions, header.whole_number({"NDims"}));
    constexpr std::int64_t kMostAxes = 10; // of MetaIO
    if (!dimensions || *dimensions < 1 || *dimensions > kMostAxes)
        return header.refused("NDims", "is no number from 1 to 10");
    const std::string* sizes = header.find({"DimSize"});
    auto extents = whole_numbers_in(sizes == nullptr ? "" : *sizes);
    if (!extents || extents->size() != static_cast<std::size_t>(*dimensions))
        return header.refused("DimSize", "does not hold one for each axis");
    return std::move(*extents);
}

// Three letters for the sides where the axes begin: "RAI" means from right, anterior, inferior, which is LPS. None:
// "???", or other text.
std::optional<glm::dmat3> axes_from_letters(const std::string& letters) {
    constexpr std::string_view kFrom = "RAILPS";
    glm::dmat3 axes(0.0);
    int used = 0;
    if (letters.size() != 3) return std::nullopt;
    for (int axis = 0; axis < 3; ++axis) {
        const std::size_t at = kFrom.find(letters[static_cast<std::size_t>(axis)]);
        if (at == std::string_view::npos) return std::nullopt;
        axes[axis][static_cast<int>(at % 3)] = at < 3 ? 1.0 : -1.0;
        used |= 1 << (at % 3);
    }
    return used == 7 ? std::optional(axes) : std::nullopt;
}

// The directions of the axes in LPS, one in each column. `axes`: their number in the file.
Result<glm::dmat3> meta_directions(const HeaderText& header, std::size_t axes, std::vector<std::string>& notes) {
    RAMUS_TRY(matrix, header.numbers({"TransformMatrix", "Rotation", "Orientation"}, axes * axes));
    const std::string* letters = header.find({"AnatomicalOrientation"});
    const auto lettered = letters == nullptr ? std::nullopt : axes_from_letters(*letters);
    glm::dmat3 directions(1.0);
    if (matrix) {
        for (std::size_t axis = 0; axis < std::min<std::size_t>(axes, 3); ++axis)
            for (std::size_t row = 0; row < std::min<std::size_t>(axes, 3); ++row)
                directions[static_cast<int>(axis)][static_cast<int>(row)] = (*matrix)[axis * axes + row];
        // Many writers set wrong letters. Other programs use the matrix too.
        bool agree = !lettered || axes < 3;
        for (int axis = 0; axis < 3 && !agree; ++axis) {
            if (!(glm::dot(directions[axis], (*lettered)[axis]) > 0.0)) break;
            agree = axis == 2;
        }
        if (!agree)
            notes.push_back("the file contradicts itself: AnatomicalOrientation " + *letters +
                            " is not what TransformMatrix says; the matrix was taken");
    } else if (lettered) {
        directions = *lettered;
    } else {
        notes.push_back(std::string(volume::kLeavesSidesOpen) + ": axes taken as left, posterior, superior");
    }
    return directions;
}

// The length of the unit in mm. None: the header names no known unit.
std::optional<double> meta_unit(const HeaderText& header) {
    const std::string* unit = header.find({"DistanceUnits"});
    return unit == nullptr ? std::nullopt : named_unit_mm(trimmed(*unit));
}

Result<glm::dmat4> meta_affine(const HeaderText& header, const glm::ivec3& size, std::size_t axes,
                               std::vector<std::string>& notes) {
    RAMUS_TRY(spacing, header.numbers({"ElementSpacing", "ElementSize"}, axes));
    RAMUS_TRY(offset, header.numbers({"Offset", "Position", "Origin"}, axes));
    RAMUS_TRY(directions, meta_directions(header, axes, notes));
    const double mm = meta_unit(header).value_or(1.0);
    if (!spacing) notes.emplace_back("the file does not say how far voxels are apart: taken as 1 mm");

    glm::dmat4 affine(1.0);
    const auto at = [](const auto& numbers, std::size_t n, double otherwise) {
        return numbers && n < numbers->size() ? (*numbers)[n] : otherwise;
    };
    for (std::size_t n = 0; n < 3; ++n) {
        const int column = static_cast<int>(n);
        affine[column] = glm::dvec4(mm * at(spacing, n, 1.0) * directions[column], 0.0);
        affine[3][column] = mm * at(offset, n, 0.0);
    }
    if (axes == 2) affine[2] = glm::dvec4(slice_axis(affine[0], affine[1]), 0.0);
    affine = lps_to_ras(affine);
    auto sound = check_affine(affine, size, "geometry (TransformMatrix, Offset, ElementSpacing)",
                              "correct where its voxels lie and write it again", header.file);
    if (!sound) return tl::unexpected(sound.error());
    return affine;
}

// The number of bytes to skip in `values`.
Result<std::uint64_t> meta_begin(const HeaderText& header, bool in_other_file, double bytes, ByteSource& values) {
    RAMUS_TRY(size, header.whole_number({"HeaderSize"}));
    const bool compressed = is_true(header, {"CompressedData"});
    const std::int64_t offset = in_other_file ? size.value_or(0) : 0;
    if (offset < 0) {
        const auto there = values.exact_bytes();
        if (offset != -1 || compressed || !there)
            return header.refused("HeaderSize", "makes no sense here: " + std::to_string(offset));
        // The values are the last bytes of the file. Missing bytes are detected later.
        const auto left = static_cast<double>(*there);
        return left > bytes ? *there - static_cast<std::uint64_t>(bytes) : std::uint64_t{0};
    }
    if (!compressed) return static_cast<std::uint64_t>(offset);
    // The file's own header is not compressed.
    if (static_cast<double>(offset) > values.most_bytes())
        return header.refused("HeaderSize", "leads beyond the end of the file");
    if (auto skipped = values.skip(static_cast<std::uint64_t>(offset)); !skipped)
        return tl::unexpected(skipped.error());
    values.inflate_rest();
    return std::uint64_t{0};
}

Result<volume::Scaling> meta_scaling(const HeaderText& header) {
    RAMUS_TRY(slope, header.numbers({"ElementToIntensityFunctionSlope"}, 1));
    RAMUS_TRY(intercept, header.numbers({"ElementToIntensityFunctionOffset"}, 1));
    volume::Scaling scaling;
    if (slope && slope->front() != 0.0) scaling.slope = slope->front();
    if (intercept) scaling.intercept = intercept->front();
    if (!std::isfinite(scaling.slope) || !std::isfinite(scaling.intercept))
        return header.refused("ElementToIntensityFunctionSlope", "or its offset is not finite");
    return scaling;
}

Encoding meta_encoding(const HeaderText& header) {
    if (header.find({"BinaryData"}) != nullptr && !is_true(header, {"BinaryData"})) return Encoding::kText;
    return binary_encoding(is_true(header, {"ElementByteOrderMSB", "BinaryDataByteOrderMSB"}));
}

} // namespace

Result<volume::Volume> read_meta_image(ByteSource& source, const ReadVolumeOptions& options, Job& job) {
    RAMUS_TRY(header, meta_header(source));
    RAMUS_TRY(type, meta_type(header));
    RAMUS_TRY(extents, meta_extents(header));
    RAMUS_TRY(size, checked_size(extents, header.file));
    std::vector<std::string> notes;
    RAMUS_TRY(affine, meta_affine(header, size, extents.size(), notes));
    const std::string& file = header.fields["ElementDataFile"];
    const double bytes = static_cast<double>(bytes_of(type)) * double(size.x) * double(size.y) * double(size.z);
    std::optional<ByteSource> values;
    bool listed = false;
    if (lower_case(file) != "local") {
        RAMUS_TRY(names, listed_files(source, file));
        if (!names.empty() && (header.find({"HeaderSize"}) != nullptr || meta_encoding(header) == Encoding::kText))
            return fail("its values are in several files, with headers or as text", header.file,
                        "write it as one file");
        auto opened = names.empty() ? open_values(source, file)
                                    : open_listed_values(source, names, bytes, is_true(header, {"CompressedData"}));
        if (!opened) return tl::unexpected(opened.error());
        listed = !names.empty();
        values = std::move(*opened);
    }
    ByteSource& from = values ? *values : source;
    std::uint64_t offset = 0;
    if (!listed) {
        RAMUS_TRY(begin, meta_begin(header, values.has_value(), bytes, from));
        offset = begin;
    }
    RAMUS_TRY(scaling, meta_scaling(header));
    const VoxelLayout layout{size, type, meta_encoding(header), scaling};
    auto volume = read_voxels(from, offset, layout, options.keeping(), job);
    if (!volume) return volume;
    volume->to_patient = affine;
    volume->type = "MetaImage, " + std::string(name_of(type));
    volume->unit_mm = meta_unit(header);
    volume->notes.insert(volume->notes.begin(), notes.begin(), notes.end());
    return volume;
}

} // namespace ramus::io
