#include "core/io/volumes/nrrd_reader.h"

#include "core/io/input_file.h"
#include "core/io/volumes/header_text.h"
#include "core/io/volumes/nrrd_space.h"
#include "core/io/volumes/slicer_segments.h"
#include "core/io/volumes/value_files.h"
#include "core/io/volumes/voxel_data.h"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

namespace ramus::io {

namespace {

struct NrrdType {
    VoxelType number;
    std::array<std::string_view, 6> words;
};
constexpr std::array<NrrdType, 10> kNrrdTypes = {
    {{VoxelType::kInt8, {"signed char", "int8", "int8_t"}},
     {VoxelType::kUint8, {"uchar", "unsigned char", "uint8", "uint8_t"}},
     {VoxelType::kInt16, {"short", "short int", "signed short", "signed short int", "int16", "int16_t"}},
     {VoxelType::kUint16, {"ushort", "unsigned short", "unsigned short int", "uint16", "uint16_t"}},
     {VoxelType::kInt32, {"int", "signed int", "int32", "int32_t"}},
     {VoxelType::kUint32, {"uint", "unsigned int", "uint32", "uint32_t"}},
     {VoxelType::kInt64,
      {"longlong", "long long", "long long int", "signed long long", "signed long long int", "int64"}},
     {VoxelType::kUint64, {"ulonglong", "unsigned long long", "unsigned long long int", "uint64", "uint64_t"}},
     {VoxelType::kFloat32, {"float"}},
     {VoxelType::kFloat64, {"double"}}}};

Result<VoxelType> nrrd_type(const HeaderText& header) {
    const std::string* text = header.find({"type"});
    if (text == nullptr) return header.refused("type", "is missing");
    const std::string word = lower_case(*text);
    for (const NrrdType& type : kNrrdTypes)
        if (!word.empty() && std::ranges::find(type.words, word) != type.words.end()) return type.number;
    if (word == "int64_t") return VoxelType::kInt64;
    if (word == "block") return fail("its voxels are blocks of bytes", header.file, "convert it to numbers");
    return header.refused("type", "is not known: " + *text);
}

// The fields, with names without blanks: the format allows "data file" and "datafile".
Result<HeaderText> nrrd_header(ByteSource& source) {
    HeaderText header{source.name(), {}};
    std::string line;
    std::size_t bytes = 0;
    RAMUS_TRY(magic, source.read_line(line, kMostHeaderBytes));
    while (magic) {
        RAMUS_TRY(more, source.read_line(line, kMostHeaderBytes));
        if (!more || line.empty()) break;
        bytes += line.size();
        if (bytes > kMostHeaderBytes)
            return fail("its header has more than 16 MB", source.name(), "write the file again");
        if (line.front() == '#') continue;
        const std::size_t colon = line.find(':');
        if (colon == std::string::npos)
            return fail("its header has a line that is no field: " + line.substr(0, 40), source.name(),
                        "correct the header, or write the file again");
        // Keys and values of programs: by ":key".
        const bool own = line.substr(colon, 2) == ":=";
        std::string key = (own ? ":" : "") + lower_case(line.substr(0, colon));
        std::erase(key, ' ');
        header.fields[key] = trimmed(std::string_view(line).substr(colon + (own ? 2 : 1)));
        // Only names of files follow.
        if (key == "datafile" && lower_case(header.fields[key]).starts_with("list")) break;
    }
    return header;
}

enum class NrrdEncoding { kRaw, kText, kGzip };

Result<NrrdEncoding> nrrd_encoding(const HeaderText& header) {
    const std::string* text = header.find({"encoding"});
    if (text == nullptr) return header.refused("encoding", "is missing");
    const std::string word = lower_case(*text);
    if (word == "raw") return NrrdEncoding::kRaw;
    if (word == "gz" || word == "gzip") return NrrdEncoding::kGzip;
    if (word == "txt" || word == "text" || word == "ascii") return NrrdEncoding::kText;
    if (word == "bz2" || word == "bzip2" || word == "hex")
        return fail("its values are encoded as " + word, header.file, "write it with the encoding gzip or raw");
    return header.refused("encoding", "is not known: " + *text);
}

// The byte order of values of several bytes; adds assumptions to `notes`.
Result<Encoding> nrrd_byte_order(const HeaderText& header, NrrdEncoding encoding, VoxelType type,
                                 std::vector<std::string>& notes) {
    if (encoding == NrrdEncoding::kText) return Encoding::kText;
    if (bytes_of(type) == 1) return Encoding::kBinary;
    const std::string* text = header.find({"endian"});
    const std::string word = text == nullptr ? "" : lower_case(*text);
    if (word == "big" || word == "little") return binary_encoding(word == "big");
    if (text != nullptr) return header.refused("endian", "is neither little nor big");
    notes.emplace_back("the file does not say in which order the bytes of a number stand: taken as little endian");
    return binary_encoding(false);
}

// Moves to the beginning of the values; returns the number of bytes to skip after it.
Result<std::uint64_t> nrrd_begin(const HeaderText& header, NrrdEncoding encoding, double bytes, ByteSource& source) {
    RAMUS_TRY(lines, header.whole_number({"lineskip"}));
    RAMUS_TRY(skip, header.whole_number({"byteskip"}));
    if (lines.value_or(0) < 0) return header.refused("line skip", "is negative");
    std::string line;
    for (std::int64_t n = 0; n < lines.value_or(0); ++n) {
        RAMUS_TRY(more, source.read_line(line, kMostHeaderBytes));
        if (!more) return header.refused("line skip", "leads beyond the end of the file");
    }
    if (encoding == NrrdEncoding::kGzip) source.inflate_rest();
    const std::int64_t offset = skip.value_or(0);
    if (offset >= 0) return static_cast<std::uint64_t>(offset);
    const auto there = source.exact_bytes();
    if (offset != -1 || encoding != NrrdEncoding::kRaw || !there)
        return header.refused("byte skip", "makes no sense with this encoding: " + std::to_string(offset));
    // The values are the last bytes of the file. Missing bytes are detected later.
    const auto left = static_cast<double>(*there);
    return left > bytes ? *there - static_cast<std::uint64_t>(bytes) : std::uint64_t{0};
}

} // namespace

Result<volume::Volume> read_nrrd(ByteSource& source, const ReadVolumeOptions& options, Job& job) {
    RAMUS_TRY(header, nrrd_header(source));
    std::vector<std::string> notes;
    const std::vector<SlicerSegment> segments = slicer_segments(header);
    RAMUS_TRY(space, nrrd_space(header, segments.empty() ? ListAxis::kRefused : ListAxis::kLayers, notes));
    RAMUS_TRY(type, nrrd_type(header));
    if (space.layers > 1 && (type == VoxelType::kFloat32 || type == VoxelType::kFloat64))
        return header.refused("type", "is not one of labels, which the layers of a segmentation are");
    RAMUS_TRY(encoding, nrrd_encoding(header));
    RAMUS_TRY(order, nrrd_byte_order(header, encoding, type, notes));
    const double bytes = static_cast<double>(bytes_of(type) * space.layers) * double(space.size.x) *
                         double(space.size.y) * double(space.size.z);
    std::optional<ByteSource> values;
    bool listed = false;
    if (const std::string* file = header.find({"datafile"})) {
        RAMUS_TRY(names, listed_files(source, *file));
        if (!names.empty() && (header.find({"lineskip", "byteskip"}) != nullptr || encoding == NrrdEncoding::kText))
            return fail("its values are in several files, with headers or as text", header.file,
                        "write it as one file");
        auto opened = names.empty() ? open_values(source, *file)
                                    : open_listed_values(source, names, bytes, encoding == NrrdEncoding::kGzip);
        if (!opened) return tl::unexpected(opened.error());
        listed = !names.empty();
        values = std::move(*opened);
    }
    ByteSource& from = values ? *values : source;
    std::uint64_t offset = 0;
    if (!listed) {
        RAMUS_TRY(begin, nrrd_begin(header, encoding, bytes, from));
        offset = begin;
    }
    std::optional<SegmentLayers> layers;
    if (space.layers > 1) layers.emplace(space.layers, segments, notes);
    const VoxelLayout layout{space.size, type, order, {}, layers ? &*layers : nullptr};
    auto volume = read_voxels(from, offset, layout, options.keeping(), job);
    if (!volume) return volume;
    volume->to_patient = space.to_patient;
    volume->type = "NRRD, " + std::string(name_of(type));
    volume->unit_mm = space.unit_mm;
    if (const std::string* unit = header.find({"sampleunits"})) volume->value_unit = *unit;
    volume->notes.insert(volume->notes.begin(), notes.begin(), notes.end());
    if (!segments.empty()) volume->label_names = layers ? layers->names() : names_of(segments);
    volume->segmentation = !segments.empty();
    if (layers) std::move(*layers).finish(*volume);
    return volume;
}

} // namespace ramus::io
