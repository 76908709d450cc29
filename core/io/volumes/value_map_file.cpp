#include "core/io/volumes/value_map_file.h"

#include "core/io/output_file.h"
#include "core/io/text_numbers.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <locale>
#include <new>
#include <nifti/nifti1.h>
#include <sstream>
#include <string_view>
#include <utility>
#include <vector>
#include <zlib.h>

namespace ramus::io {

namespace {

// Passes bytes on to a file, compressed by gzip or as they are.
class Bytes {
public:
    Bytes(OutputFile& file, bool compressed) : file_(file), compressed_(compressed) {
        // The fastest level: label maps are long runs, and the noise of scans does not compress; both gain little by a
        // slower one. 16: with gzip's header.
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

struct WrittenType {
    short nifti;
    short bytes;
    const char* nrrd;
};
// In the order of ValueMap::fill_slice.
constexpr std::array<WrittenType, 5> kWrittenTypes = {{{DT_UINT8, 1, "unsigned char"},
                                                       {DT_UINT16, 2, "unsigned short"},
                                                       {DT_INT16, 2, "short"},
                                                       {DT_INT32, 4, "int"},
                                                       {DT_FLOAT32, 4, "float"}}};
const WrittenType& type_of(const ValueMap& map) { return kWrittenTypes.at(map.fill_slice.index()); }

void write_nifti_header(const ValueMap& map, Bytes& to) {
    nifti_1_header header{};
    header.sizeof_hdr = sizeof header;
    header.dim[0] = 3;
    const glm::dvec3 spacing = volume::spacing_mm(map.to_patient);
    for (int axis = 0; axis < 3; ++axis) {
        header.dim[axis + 1] = static_cast<short>(map.size[axis]);
        header.pixdim[axis + 1] = static_cast<float>(spacing[axis]);
    }
    std::fill(header.dim + 4, header.dim + 8, short{1});
    header.datatype = type_of(map).nifti;
    header.bitpix = static_cast<short>(8 * type_of(map).bytes);
    header.vox_offset = static_cast<float>(sizeof header + 4 + map.nifti_extension.size());
    header.intent_code = static_cast<short>(map.nifti_intent);
    header.xyzt_units = map.claims.has_unit() ? NIFTI_UNITS_MM : NIFTI_UNITS_UNKNOWN;
    if (map.window) {
        header.cal_min = static_cast<float>(map.window->centre - 0.5 * map.window->width);
        header.cal_max = static_cast<float>(map.window->centre + 0.5 * map.window->width);
    }
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
    const std::array<char, 4> extended{map.nifti_extension.empty() ? char{0} : char{1}, 0, 0, 0};
    to.write(extended.data(), extended.size());
    to.write(map.nifti_extension.data(), map.nifti_extension.size());
}

// A field is a line.
std::string one_line(std::string text) {
    std::ranges::replace_if(
        text, [](char c) { return c == '\n' || c == '\r'; }, ' ');
    return text;
}

std::string written_nrrd_header(const ValueMap& map) {
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
    text << "NRRD0004\n# written by ramus\ntype: " << type_of(map).nrrd
         << "\ndimension: 3\nspace: right-anterior-superior\nsizes: " << map.size.x << ' ' << map.size.y << ' '
         << map.size.z << "\nspace directions: " << vector(glm::dvec3(m[0])) << ' ' << vector(glm::dvec3(m[1])) << ' '
         << vector(glm::dvec3(m[2])) << "\nkinds: domain domain domain\n";
    if (type_of(map).bytes > 1) text << "endian: little\n";
    text << "encoding: gzip\nspace origin: " << vector(glm::dvec3(m[3])) << '\n';
    if (map.claims.has_unit()) text << "space units: \"mm\" \"mm\" \"mm\"\n";
    if (!map.value_unit.empty()) text << "sample units: " << one_line(map.value_unit) << '\n';
    text << map.nrrd_fields << '\n';
    return text.str();
}

// All slices. False: cancelled.
template <class T>
bool write_slices(const ValueMap& map, const FillSlice<T>& fill_slice, Bytes& to, const JobRange& job) {
    std::vector<T> slice(static_cast<std::size_t>(map.size.x) * static_cast<std::size_t>(map.size.y));
    for (int k = 0; k < map.size.z; ++k) {
        if (job.cancelled()) return false;
        std::ranges::fill(slice, T(0));
        fill_slice(k, slice);
        to.write(slice.data(), slice.size() * sizeof(T));
        job.report(static_cast<float>(k + 1) / static_cast<float>(map.size.z));
    }
    return true;
}

template <class T> FillSlice<T> slices_of(const SparseArray<T>& values, std::size_t in_slice) {
    return [&values, in_slice](int k, std::span<T> slice) {
        std::copy_n(values.data() + static_cast<std::size_t>(k) * in_slice, in_slice, slice.data());
    };
}
template <class T> FillSlice<T> slices_of(const volume::RunsOf<T>& runs, std::size_t in_slice) {
    return [&runs, in_slice](int k, std::span<T> slice) {
        const std::size_t first = static_cast<std::size_t>(k) * in_slice;
        runs.for_runs(first, first + in_slice, [&](std::size_t begin, std::size_t end, T value) {
            std::fill(slice.data() + (begin - first), slice.data() + (end - first), value);
        });
    };
}

} // namespace

ValueMap value_map(const volume::Volume& volume, const tree::Claims& claims) {
    const std::size_t in_slice = static_cast<std::size_t>(volume.size.x) * static_cast<std::size_t>(volume.size.y);
    ValueMap map{.size = volume.size, .to_patient = volume.to_patient, .claims = claims, .fill_slice = {}};
    std::visit([&](const auto& values) { map.fill_slice = slices_of(values, in_slice); }, volume.voxels);
    map.value_unit = volume.value_unit;
    map.window = volume.window;
    return map;
}

std::string value_map_extensions() { return ".nii.gz, .nii or .nrrd"; }

bool names_value_map(const std::filesystem::path& target) { return is_nifti(target) || ends_in(target, ".nrrd"); }

Result<void> check_value_map_output(const std::filesystem::path& target) {
    if (!names_value_map(target))
        return fail("a volume is not written in this format", target.string(), value_map_extensions());
    return check_output(target);
}

Result<void> write_value_map(const ValueMap& map, const std::filesystem::path& target, const JobRange& job) {
    static_assert(std::endian::native == std::endian::little);
    if (auto possible = check_value_map_output(target); !possible) return possible;
    constexpr int kMostOfASide = 32767; // of NIfTI-1
    if (std::max({map.size.x, map.size.y, map.size.z}) > kMostOfASide)
        return fail("a side has more than 32,767 voxels", target.string(), "crop the volume");
    RAMUS_TRY(file, OutputFile::create(target));
    const bool nifti = is_nifti(target);
    if (!nifti) file.write(written_nrrd_header(map));
    Bytes bytes(file, !ends_in(target, ".nii"));
    if (nifti) write_nifti_header(map, bytes);
    const bool all = std::visit([&](const auto& fill) { return write_slices(map, fill, bytes, job); }, map.fill_slice);
    if (!all) return fail("cancelled");
    bytes.finish();
    return file.commit();
}

} // namespace ramus::io
