#include "core/io/volumes/label_map_file.h"

#include "core/io/output_file.h"
#include "core/io/text_numbers.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <new>
#include <nifti/nifti1.h>
#include <pugixml.hpp>
#include <sstream>
#include <string_view>
#include <zlib.h>

namespace ramus::io {

namespace {

// Passes bytes on to a file, compressed by gzip or as they are.
class Bytes {
public:
    Bytes(OutputFile& file, bool compressed) : file_(file), compressed_(compressed) {
        // The fastest level: label maps are long runs, and gain nothing by a slower one. 16: with gzip's header.
        constexpr int kGzip = MAX_WBITS + 16;
        if (compressed && deflateInit2(&stream_, Z_BEST_SPEED, Z_DEFLATED, kGzip, 8, Z_DEFAULT_STRATEGY) != Z_OK)
            throw std::bad_alloc(); // nothing else can fail with these arguments
    }
    ~Bytes() {
        if (compressed_) deflateEnd(&stream_);
    }
    Bytes(const Bytes&) = delete;
    Bytes& operator=(const Bytes&) = delete;

    void write(const void* bytes, std::size_t count) {
        if (!compressed_) return file_.write(bytes, count);
        constexpr std::size_t kMost = std::size_t{1} << 30; // of zlib's counter
        const auto* next = static_cast<const Bytef*>(bytes);
        for (std::size_t left = count; left > 0;) {
            const std::size_t now = std::min(left, kMost);
            put(next, now, Z_NO_FLUSH);
            next += now;
            left -= now;
        }
    }
    void finish() {
        if (compressed_) put(nullptr, 0, Z_FINISH);
    }

private:
    void put(const Bytef* bytes, std::size_t count, int flush) {
        stream_.next_in = const_cast<Bytef*>(bytes); // zlib does not write to it
        stream_.avail_in = static_cast<uInt>(count);
        do {
            stream_.next_out = buffer_.data();
            stream_.avail_out = static_cast<uInt>(buffer_.size());
            (void)deflate(&stream_, flush);
            file_.write(buffer_.data(), buffer_.size() - stream_.avail_out);
        } while (stream_.avail_out == 0);
    }

    OutputFile& file_;
    bool compressed_;
    z_stream stream_{};
    std::array<Bytef, std::size_t{1} << 16> buffer_{};
};

bool ends_in(const std::filesystem::path& target, std::string_view extension) {
    return lower_case(target.filename().string()).ends_with(extension);
}
bool is_nifti(const std::filesystem::path& target) { return ends_in(target, ".nii") || ends_in(target, ".nii.gz"); }

bool takes_two_bytes(const LabelMap& map) {
    return std::ranges::any_of(map.names, [](const volume::LabelName& name) { return name.label > 255; });
}

std::array<double, 3> shares(const volume::LabelName& name) {
    const auto colour = name.colour.value_or(std::array<std::uint8_t, 3>{128, 128, 128});
    return {colour[0] / 255.0, colour[1] / 255.0, colour[2] / 255.0};
}

// The extension: its size and code, then XML, padded to a multiple of 16 bytes.
std::string label_table(const std::vector<volume::LabelName>& names) {
    pugi::xml_document document;
    pugi::xml_node table = document.append_child("LabelTable");
    for (const volume::LabelName& name : names) {
        pugi::xml_node label = table.append_child("Label");
        label.append_attribute("Key") = name.label;
        const auto colour = shares(name);
        for (const auto& [key, n] : {std::pair("Red", 0), {"Green", 1}, {"Blue", 2}})
            label.append_attribute(key) = colour.at(static_cast<std::size_t>(n));
        label.append_attribute("Alpha") = 1;
        label.append_child(pugi::node_pcdata).set_value(name.name.c_str());
    }
    std::ostringstream text;
    document.save(text, "", pugi::format_raw);
    std::string content = text.str();
    constexpr std::size_t kHead = 8, kStep = 16;
    const std::size_t size = (kHead + content.size() + 1 + kStep - 1) / kStep * kStep;
    content.resize(size - kHead, '\0');
    const std::array<std::int32_t, 2> head{static_cast<std::int32_t>(size),
                                           30}; // 30: Caret, whose XML has label tables
    return std::string(reinterpret_cast<const char*>(head.data()), sizeof head) + content;
}

void write_nifti_header(const LabelMap& map, Bytes& to) {
    const std::string extension = label_table(map.names);
    nifti_1_header header{};
    header.sizeof_hdr = sizeof header;
    header.dim[0] = 3;
    const glm::dvec3 spacing = volume::spacing_mm(map.to_patient);
    for (int axis = 0; axis < 3; ++axis) {
        header.dim[axis + 1] = static_cast<short>(map.size[axis]);
        header.pixdim[axis + 1] = static_cast<float>(spacing[axis]);
    }
    std::fill(header.dim + 4, header.dim + 8, short{1});
    header.datatype = takes_two_bytes(map) ? DT_UINT16 : DT_UINT8;
    header.bitpix = takes_two_bytes(map) ? 16 : 8;
    header.vox_offset = static_cast<float>(sizeof header + 4 + extension.size());
    header.intent_code = NIFTI_INTENT_LABEL;
    header.xyzt_units = map.claims.has_unit() ? NIFTI_UNITS_MM : NIFTI_UNITS_UNKNOWN;
    // A code of 0 would make readers forget origin and directions.
    header.sform_code = NIFTI_XFORM_SCANNER_ANAT;
    for (int k = 0; k < 4; ++k) {
        header.srow_x[k] = static_cast<float>(map.to_patient[k].x);
        header.srow_y[k] = static_cast<float>(map.to_patient[k].y);
        header.srow_z[k] = static_cast<float>(map.to_patient[k].z);
    }
    std::memcpy(header.descrip, "ramus", 6);
    std::memcpy(header.magic, "n+1", 4);
    to.write(&header, sizeof header);
    constexpr std::array<char, 4> kExtended{1, 0, 0, 0};
    to.write(kExtended.data(), kExtended.size());
    to.write(extension.data(), extension.size());
}

// A value of a NRRD key: a line.
std::string escaped(std::string_view text) {
    std::string line;
    for (const char c : text) line += c == '\\' ? "\\\\" : c == '\n' ? "\\n" : c == '\r' ? " " : std::string(1, c);
    return line;
}

std::string nrrd_header(const LabelMap& map) {
    std::ostringstream text;
    text.imbue(std::locale::classic());
    text.precision(17);
    const auto vector = [](const glm::dvec3& v) {
        std::ostringstream one;
        one.imbue(std::locale::classic());
        one.precision(17);
        one << '(' << v.x << ',' << v.y << ',' << v.z << ')';
        return one.str();
    };
    const glm::dmat4& m = map.to_patient;
    text << "NRRD0004\n# written by ramus\ntype: " << (takes_two_bytes(map) ? "unsigned short" : "unsigned char")
         << "\ndimension: 3\nspace: right-anterior-superior\nsizes: " << map.size.x << ' ' << map.size.y << ' '
         << map.size.z << "\nspace directions: " << vector(glm::dvec3(m[0])) << ' ' << vector(glm::dvec3(m[1])) << ' '
         << vector(glm::dvec3(m[2])) << "\nkinds: domain domain domain\n";
    if (takes_two_bytes(map)) text << "endian: little\n";
    text << "encoding: gzip\nspace origin: " << vector(glm::dvec3(m[3])) << '\n';
    if (map.claims.has_unit()) text << "space units: \"mm\" \"mm\" \"mm\"\n";
    const glm::ivec3 last = map.size - 1;
    for (std::size_t n = 0; n < map.names.size(); ++n) {
        const volume::LabelName& name = map.names[n];
        const std::string segment = "Segment" + std::to_string(n) + "_";
        const auto colour = shares(name);
        text.precision(6);
        text << segment << "ID:=Segment_" << name.label << '\n'
             << segment << "Name:=" << escaped(name.name) << '\n'
             << segment << "NameAutoGenerated:=0\n"
             << segment << "Color:=" << colour[0] << ' ' << colour[1] << ' ' << colour[2] << '\n'
             << segment << "ColorAutoGenerated:=0\n"
             << segment << "Extent:=0 " << last.x << " 0 " << last.y << " 0 " << last.z << '\n'
             << segment << "LabelValue:=" << name.label << '\n'
             << segment << "Layer:=0\n";
    }
    text << "Segmentation_ContainedRepresentationNames:=Binary labelmap|\n"
            "Segmentation_MasterRepresentation:=Binary labelmap\n"
            "Segmentation_SourceRepresentation:=Binary labelmap\n\n";
    return text.str();
}

// All slices. False: cancelled.
bool write_voxels(const LabelMap& map, Bytes& to, const JobRange& job) {
    std::vector<std::uint16_t> slice(static_cast<std::size_t>(map.size.x) * static_cast<std::size_t>(map.size.y));
    std::vector<std::uint8_t> narrow(takes_two_bytes(map) ? 0 : slice.size());
    for (int k = 0; k < map.size.z; ++k) {
        if (job.cancelled()) return false;
        std::ranges::fill(slice, std::uint16_t{0});
        map.fill_slice(k, slice);
        if (narrow.empty()) {
            to.write(slice.data(), slice.size() * sizeof slice.front());
        } else {
            std::ranges::transform(slice, narrow.begin(),
                                   [](std::uint16_t label) { return static_cast<std::uint8_t>(label); });
            to.write(narrow.data(), narrow.size());
        }
        job.report(static_cast<float>(k + 1) / static_cast<float>(map.size.z));
    }
    return true;
}

} // namespace

std::string label_map_extensions() { return ".nii.gz, .nii, .seg.nrrd or .nrrd"; }

Result<void> check_label_map_output(const std::filesystem::path& target) {
    if (!is_nifti(target) && !ends_in(target, ".nrrd"))
        return fail("a label map is not written in this format", target.string(), label_map_extensions());
    return check_output(target);
}

Result<void> write_label_map(const LabelMap& map, const std::filesystem::path& target, const JobRange& job) {
    static_assert(std::endian::native == std::endian::little);
    if (auto possible = check_label_map_output(target); !possible) return possible;
    constexpr int kMostOfASide = 32767; // of NIfTI-1
    if (std::max({map.size.x, map.size.y, map.size.z}) > kMostOfASide)
        return fail("a side has more than 32,767 voxels", target.string(), "crop the mask");
    RAMUS_TRY(file, OutputFile::create(target));
    const bool nifti = is_nifti(target);
    if (!nifti) file.write(nrrd_header(map));
    Bytes bytes(file, !ends_in(target, ".nii"));
    if (nifti) write_nifti_header(map, bytes);
    if (!write_voxels(map, bytes, job)) return fail("cancelled");
    bytes.finish();
    return file.commit();
}

} // namespace ramus::io
