#include "core/io/volumes/nifti_reader.h"

#include "core/base/memory.h"
#include "core/tree/build_tree.h"
#include "core/volume/voxel_store.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <nifti/nifti2_io.h>
#include <string>

namespace ramus::io {

namespace {

// What a header says, in this machine's byte order.
struct Header {
    std::array<std::int64_t, 8> dim{};
    std::array<double, 4> pixdim{}; // [0]: the sign of qfac
    std::int64_t offset = 0;        // of the first voxel
    double slope = 0.0, intercept = 0.0;
    int type = 0, qform = 0, sform = 0, units = 0;
    std::array<double, 3> quaternion{}, origin{};
    std::array<std::array<double, 4>, 3> rows{};
    std::array<char, 4> magic{};
    int version = 1;
    bool swapped = false;
};

template <class Raw> Result<Header> header_of(Raw raw, int version, const std::string& name) {
    Header header;
    header.version = version;
    header.swapped = raw.sizeof_hdr != static_cast<int>(sizeof(Raw));
    if (header.swapped) swap_nifti_header(&raw, version);
    std::copy(std::begin(raw.dim), std::end(raw.dim), header.dim.begin());
    std::copy_n(std::begin(raw.pixdim), 4, header.pixdim.begin());
    std::copy_n(std::begin(raw.magic), 4, header.magic.begin());
    const auto offset = static_cast<double>(raw.vox_offset);
    if (!(offset >= 0.0 && offset < 9e15))
        return fail("its header says that the voxels begin nowhere in the file", name, "write the file again");
    // Some writers leave 0, and mean: right behind the header.
    header.offset = std::max(static_cast<std::int64_t>(offset), static_cast<std::int64_t>(sizeof(Raw)));
    header.slope = raw.scl_slope;
    header.intercept = raw.scl_inter;
    header.type = raw.datatype;
    header.qform = raw.qform_code;
    header.sform = raw.sform_code;
    header.units = XYZT_TO_SPACE(raw.xyzt_units);
    header.quaternion = {raw.quatern_b, raw.quatern_c, raw.quatern_d};
    header.origin = {raw.qoffset_x, raw.qoffset_y, raw.qoffset_z};
    std::copy_n(raw.srow_x, 4, header.rows[0].begin());
    std::copy_n(raw.srow_y, 4, header.rows[1].begin());
    std::copy_n(raw.srow_z, 4, header.rows[2].begin());
    return header;
}

Result<Header> parse_header(std::string_view head, const std::string& name) {
    const int version = nifti_version(head);
    if (version == 2) {
        nifti_2_header raw;
        if (head.size() < sizeof raw) return fail("the file ends within its header", name, "copy or write it again");
        std::memcpy(&raw, head.data(), sizeof raw);
        return header_of(raw, 2, name);
    }
    nifti_1_header raw;
    std::memcpy(&raw, head.data(), sizeof raw);
    if (version == 0)
        return fail("this is an ANALYZE 7.5 header, which does not say where left and right are", name,
                    "convert the pair of files to one .nii or .nii.gz file");
    return header_of(raw, 1, name);
}

Result<glm::ivec3> size_of(const Header& header, const std::string& name) {
    const std::int64_t dimensions = header.dim[0];
    if (dimensions < 1 || dimensions > 7)
        return fail("its header counts " + std::to_string(dimensions) + " dimensions", name, "write the file again");
    std::array<std::int64_t, 3> size{1, 1, 1};
    for (std::size_t axis = 1; axis <= static_cast<std::size_t>(dimensions); ++axis) {
        const std::int64_t extent = header.dim[axis];
        if (extent < 1 || extent > 2147483647)
            return fail("its extent along axis " + std::to_string(axis) + " is " + std::to_string(extent), name,
                        "write the file again");
        if (axis <= 3)
            size[axis - 1] = extent;
        else if (extent > 1)
            return fail("it holds " + std::to_string(extent) + " volumes, along axis " + std::to_string(axis), name,
                        "write the one that is meant to a file of its own");
    }
    return glm::ivec3(size[0], size[1], size[2]);
}

// Voxel sizes that the qform, or their having to do alone, makes use of. Axes that are not there have one voxel.
Result<glm::dvec3> voxel_size(const Header& header, const std::string& name) {
    glm::dvec3 spacing(1.0);
    for (int axis = 0; axis < 3; ++axis) {
        const double size = header.pixdim[static_cast<std::size_t>(axis) + 1];
        if (size > 0.0 && std::isfinite(size)) {
            spacing[axis] = size;
        } else if (axis < header.dim[0]) {
            return fail("its voxel size along axis " + std::to_string(axis + 1) + " is not a length", name,
                        "set pixdim[" + std::to_string(axis + 1) + "] to mm from voxel to voxel");
        }
    }
    return spacing;
}

Result<glm::dmat4> matrix_of(const Header& header, const std::string& name) {
    glm::dmat4 matrix(1.0);
    if (header.sform > 0) {
        for (int row = 0; row < 3; ++row)
            for (int column = 0; column < 4; ++column)
                matrix[column][row] = header.rows[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)];
        return matrix;
    }
    RAMUS_TRY(spacing, voxel_size(header, name));
    if (header.qform <= 0) {
        for (int axis = 0; axis < 3; ++axis) matrix[axis][axis] = spacing[axis];
        return matrix;
    }
    const auto& [b, c, d] = header.quaternion;
    constexpr double kRounding = 1e-3; // of single precision, generously
    if (!(b * b + c * c + d * d <= 1.0 + kRounding))
        return fail("the quaternion of its qform is no rotation", name, "write the file again, with an sform");
    const nifti_dmat44 rows =
        nifti_quatern_to_dmat44(b, c, d, header.origin[0], header.origin[1], header.origin[2], spacing.x, spacing.y,
                                spacing.z, header.pixdim[0] < 0.0 ? -1.0 : 1.0);
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 4; ++column) matrix[column][row] = rows.m[row][column];
    return matrix;
}

// In mm, and such that it can be turned round.
Result<glm::dmat4> affine_of(const Header& header, const glm::ivec3& size, const std::string& name) {
    auto matrix = matrix_of(header, name);
    if (!matrix) return matrix;
    const double unit = header.units == NIFTI_UNITS_METER ? 1e3 : header.units == NIFTI_UNITS_MICRON ? 1e-3 : 1.0;
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 3; ++row) (*matrix)[column][row] *= unit;
    const char* form = header.sform > 0 ? "sform" : header.qform > 0 ? "qform" : "set of voxel sizes";
    const std::string remedy = "correct where its voxels lie (sform or qform) and write it again";
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec4 voxel((corner & 1) != 0 ? size.x : 0, (corner & 2) != 0 ? size.y : 0,
                               (corner & 4) != 0 ? size.z : 0, 1.0);
        const glm::dvec4 place = *matrix * voxel;
        for (int axis = 0; axis < 3; ++axis)
            if (!(std::abs(place[axis]) <= tree::kMaximumCoordinate))
                return fail(std::string("its ") + form + " puts voxels where no patient is, " +
                                (std::isfinite(place[axis]) ? "10 km away or farther" : "at no number"),
                            name, remedy);
    }
    const glm::dvec3 spacing = volume::spacing_mm(*matrix);
    constexpr double kFlat = 1e-9; // of the volume that the axes would span at right angles
    if (!(volume::voxel_volume_mm3(*matrix) > kFlat * spacing.x * spacing.y * spacing.z))
        return fail(std::string("its ") + form + " presses all voxels into one plane", name, remedy);
    return matrix;
}

Result<volume::Scaling> scaling_of(const Header& header, const std::string& name) {
    // A slope of 0 means that there is none, and so do other programs take one that is no number.
    if (header.slope == 0.0 || !std::isfinite(header.slope)) return volume::Scaling{};
    if (!std::isfinite(header.intercept))
        return fail("the intercept of its values (scl_inter) is no number", name, "write the file again");
    return volume::Scaling{header.slope, header.intercept};
}

struct Reading {
    ByteSource& source;
    const Header& header;
    volume::Scaling scaling;
    std::size_t voxels;
    Job& job;
};

template <class Raw> Result<void> read_voxels(const Reading& reading, volume::VoxelStore& store) {
    // A megabyte at a time, for even one slice may be a claim too large.
    constexpr std::size_t kAtOnce = (std::size_t{1} << 20) / sizeof(Raw);
    std::vector<Raw> raw(std::min(kAtOnce, reading.voxels));
    for (std::size_t done = 0; done < reading.voxels;) {
        if (reading.job.cancelled()) return fail("cancelled");
        const std::size_t count = std::min(raw.size(), reading.voxels - done);
        if (auto got = reading.source.read(raw.data(), count * sizeof(Raw)); !got) return got;
        if (reading.header.swapped && sizeof(Raw) > 1) nifti_swap_Nbytes(count, sizeof(Raw), raw.data());
        if (auto kept = store.append(raw.data(), count, reading.scaling); !kept) return kept;
        done += count;
        reading.job.report(static_cast<float>(done) / static_cast<float>(reading.voxels));
    }
    return reading.source.check_end();
}

struct Type {
    int code;
    const char* name;
    std::size_t bytes;
    Result<void> (*read)(const Reading&, volume::VoxelStore&);
};
constexpr std::array<Type, 10> kTypes = {{{DT_UINT8, "uint8", 1, read_voxels<std::uint8_t>},
                                          {DT_INT8, "int8", 1, read_voxels<std::int8_t>},
                                          {DT_UINT16, "uint16", 2, read_voxels<std::uint16_t>},
                                          {DT_INT16, "int16", 2, read_voxels<std::int16_t>},
                                          {DT_UINT32, "uint32", 4, read_voxels<std::uint32_t>},
                                          {DT_INT32, "int32", 4, read_voxels<std::int32_t>},
                                          {DT_UINT64, "uint64", 8, read_voxels<std::uint64_t>},
                                          {DT_INT64, "int64", 8, read_voxels<std::int64_t>},
                                          {DT_FLOAT32, "float32", 4, read_voxels<float>},
                                          {DT_FLOAT64, "float64", 8, read_voxels<double>}}};

Result<Type> type_of(const Header& header, const std::string& name) {
    const auto* known = std::ranges::find_if(kTypes, [&](const Type& type) { return type.code == header.type; });
    if (known != kTypes.end()) return *known;
    const char* remedy = "convert it to whole numbers, or to single precision";
    switch (header.type) {
    case DT_RGB24:
    case DT_RGBA32:
        return fail("its voxels are colours", name, remedy);
    case DT_COMPLEX64:
    case DT_COMPLEX128:
    case DT_COMPLEX256:
        return fail("its voxels are complex numbers", name, remedy);
    case DT_FLOAT128:
        return fail("its voxels are numbers of 128 bits", name, remedy);
    case DT_BINARY:
        return fail("its voxels are single bits", name, remedy);
    default:
        return fail("its voxels are of the unknown type " + std::to_string(header.type), name, remedy);
    }
}

// Whether so many voxels can come, and may be kept; in numbers that do not overflow.
Result<void> check_claim(const glm::ivec3& size, const Header& header, const Type& type, const ByteSource& source,
                         double memory_bytes) {
    const double voxels = double(size.x) * double(size.y) * double(size.z);
    const std::string claim = "its header claims " + std::to_string(size.x) + " x " + std::to_string(size.y) + " x " +
                              std::to_string(size.z) + " voxels";
    if (voxels * static_cast<double>(type.bytes) + static_cast<double>(header.offset) > source.most_bytes())
        return fail(claim + ", more than the file can hold", source.name(), "copy or write it again");
    if (voxels > memory_bytes)
        return fail(claim + ", which take " + std::to_string(std::llround(voxels / 1e6)) + " MB of memory or more; " +
                        std::to_string(std::llround(memory_bytes / 1e6)) + " MB are left to them",
                    source.name(), "crop it, or allow more with --memory");
    return {};
}

} // namespace

int nifti_version(std::string_view head) {
    nifti_set_debug_level(0); // it would speak on standard error
    return nifti_header_version(head.data(), head.size());
}

Result<volume::Volume> read_nifti(ByteSource& source, const ReadVolumeOptions& options, Job& job) {
    const std::string& name = source.name();
    RAMUS_TRY(header, parse_header(source.head(), name));
    if (header.magic[1] != '+')
        return fail("this is half of a pair of files (.hdr and .img)", name,
                    "convert the pair to one .nii or .nii.gz file");
    RAMUS_TRY(size, size_of(header, name));
    RAMUS_TRY(type, type_of(header, name));
    RAMUS_TRY(affine, affine_of(header, size, name));
    RAMUS_TRY(scaling, scaling_of(header, name));
    const double memory = memory_left(options.memory_bytes);
    if (auto fits = check_claim(size, header, type, source, memory); !fits) return tl::unexpected(fits.error());

    volume::VoxelStore store(size, memory, name);
    const auto voxels =
        static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y) * static_cast<std::size_t>(size.z);
    if (auto skipped = source.skip(static_cast<std::uint64_t>(header.offset)); !skipped)
        return tl::unexpected(skipped.error());
    if (auto read = type.read({source, header, scaling, voxels, job}, store); !read)
        return tl::unexpected(read.error());
    volume::Volume volume;
    std::move(store).finish(volume);
    volume.to_patient = affine;
    volume.type = "NIfTI-" + std::to_string(header.version) + ", " + type.name;
    if (header.units != NIFTI_UNITS_MM && header.units != NIFTI_UNITS_METER && header.units != NIFTI_UNITS_MICRON)
        volume.notes.emplace_back("the file names no unit of length: taken as mm");
    if (header.sform <= 0 && header.qform <= 0)
        volume.notes.emplace_back(
            "the file does not say how the patient lies: axes taken as right, anterior, superior");
    return volume;
}

} // namespace ramus::io
