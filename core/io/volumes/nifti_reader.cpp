#include "core/io/volumes/nifti_reader.h"

#include "core/io/text_numbers.h"
#include "core/io/volumes/nifti_extensions.h"
#include "core/io/volumes/voxel_data.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <nifti/nifti2_io.h>
#include <string>

namespace ramus::io {

namespace {

// The fields of a header, in this machine's byte order.
struct Header {
    std::array<std::int64_t, 8> dim{};
    std::array<double, 4> pixdim{}; // [0]: the sign of qfac
    std::int64_t offset = 0;        // of the first voxel
    double slope = 0.0, intercept = 0.0;
    double darkest = 0.0, brightest = 0.0; // values to display; equal: not stated
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
    // Some writers set 0 if the voxels directly follow the header.
    header.offset = std::max(static_cast<std::int64_t>(offset), static_cast<std::int64_t>(sizeof(Raw)));
    header.slope = raw.scl_slope;
    header.intercept = raw.scl_inter;
    header.darkest = raw.cal_min;
    header.brightest = raw.cal_max;
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
    return checked_size({header.dim.begin() + 1, header.dim.begin() + 1 + dimensions}, name);
}

// Voxel sizes, for the qform or if there is no form. Missing axes have size 1.
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

glm::dmat4 sform_of(const Header& header) {
    glm::dmat4 matrix(1.0);
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 4; ++column)
            matrix[column][row] = header.rows[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)];
    return matrix;
}

Result<glm::dmat4> qform_of(const Header& header, const std::string& name) {
    glm::dmat4 matrix(1.0);
    RAMUS_TRY(spacing, voxel_size(header, name));
    const auto& [b, c, d] = header.quaternion;
    constexpr double kRounding = 1e-3; // generous tolerance for single precision
    if (!(b * b + c * c + d * d <= 1.0 + kRounding))
        return fail("the quaternion of its qform is no rotation", name, "write the file again, with an sform");
    const nifti_dmat44 rows =
        nifti_quatern_to_dmat44(b, c, d, header.origin[0], header.origin[1], header.origin[2], spacing.x, spacing.y,
                                spacing.z, header.pixdim[0] < 0.0 ? -1.0 : 1.0);
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 4; ++column) matrix[column][row] = rows.m[row][column];
    return matrix;
}

Result<glm::dmat4> matrix_of(const Header& header, const std::string& name) {
    if (header.sform > 0) return sform_of(header);
    if (header.qform > 0) return qform_of(header, name);
    RAMUS_TRY(spacing, voxel_size(header, name));
    glm::dmat4 matrix(1.0);
    for (int axis = 0; axis < 3; ++axis) matrix[axis][axis] = spacing[axis];
    return matrix;
}

// The length of the unit in mm. None: the header names no unit.
std::optional<double> unit_of(const Header& header) {
    switch (header.units) {
    case NIFTI_UNITS_MM:
        return 1.0;
    case NIFTI_UNITS_METER:
        return 1e3;
    case NIFTI_UNITS_MICRON:
        return 1e-3;
    default:
        return std::nullopt;
    }
}

// The affine to mm, invertible.
Result<glm::dmat4> affine_of(const Header& header, const glm::ivec3& size, const std::string& name) {
    auto matrix = matrix_of(header, name);
    if (!matrix) return matrix;
    const double unit = unit_of(header).value_or(1.0);
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 3; ++row) (*matrix)[column][row] *= unit;
    const char* form = header.sform > 0 ? "sform" : header.qform > 0 ? "qform" : "set of voxel sizes";
    auto sound =
        check_affine(*matrix, size, form, "correct where its voxels lie (sform or qform) and write it again", name);
    if (!sound) return tl::unexpected(sound.error());
    return matrix;
}

// A note if the volume has both forms and they differ by more than a tenth of a voxel at a corner.
std::optional<std::string> forms_differ(const Header& header, const glm::ivec3& size, const std::string& name) {
    if (header.sform <= 0 || header.qform <= 0) return std::nullopt;
    const auto qform = qform_of(header, name);
    if (!qform) return std::nullopt; // invalid, and not used
    const glm::dmat4 sform = sform_of(header);
    double most = 0.0;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec4 at(glm::dvec3(corner & 1, corner >> 1 & 1, corner >> 2) * glm::dvec3(size - 1), 1.0);
        most = std::max(most, glm::length(glm::dvec3(sform * at - *qform * at)));
    }
    const glm::dvec3 step = volume::spacing_mm(sform);
    constexpr double kOfVoxel = 0.1;
    if (!(most > kOfVoxel * std::min({step.x, step.y, step.z}))) return std::nullopt;
    return "the sform and the qform of the file differ, by up to " +
           short_number(unit_of(header).value_or(1.0) * most) + " mm within the volume: the sform was taken";
}

Result<volume::Scaling> scaling_of(const Header& header, const std::string& name) {
    // A slope of 0 means no scaling. Other programs treat NaN in the same way.
    if (header.slope == 0.0 || !std::isfinite(header.slope)) return volume::Scaling{};
    if (!std::isfinite(header.intercept))
        return fail("the intercept of its values (scl_inter) is no number", name, "write the file again");
    return volume::Scaling{header.slope, header.intercept};
}

std::optional<volume::DisplayWindow> window_of(const Header& header) {
    const double width = header.brightest - header.darkest;
    if (!(width > 0.0) || !std::isfinite(width)) return std::nullopt;
    return volume::DisplayWindow{header.darkest + 0.5 * width, width};
}

struct NiftiNumber {
    int code;
    VoxelType number;
};
constexpr std::array<NiftiNumber, 10> kNiftiTypes = {{{DT_UINT8, VoxelType::kUint8},
                                                      {DT_INT8, VoxelType::kInt8},
                                                      {DT_UINT16, VoxelType::kUint16},
                                                      {DT_INT16, VoxelType::kInt16},
                                                      {DT_UINT32, VoxelType::kUint32},
                                                      {DT_INT32, VoxelType::kInt32},
                                                      {DT_UINT64, VoxelType::kUint64},
                                                      {DT_INT64, VoxelType::kInt64},
                                                      {DT_FLOAT32, VoxelType::kFloat32},
                                                      {DT_FLOAT64, VoxelType::kFloat64}}};

Result<VoxelType> type_of(const Header& header, const std::string& name) {
    const auto* known = std::ranges::find(kNiftiTypes, header.type, &NiftiNumber::code);
    if (known != kNiftiTypes.end()) return known->number;
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

// The bytes between the header and the voxels, and how many bytes of the file were read for them.
struct Extensions {
    std::vector<volume::LabelName> names;
    std::vector<std::string> notes;
    std::uint64_t used = 0;
};

Result<Extensions> extensions_of(const Header& header, ByteSource& source) {
    Extensions found;
    const std::uint64_t begin = header.version == 2 ? sizeof(nifti_2_header) : sizeof(nifti_1_header);
    const auto offset = static_cast<std::uint64_t>(header.offset);
    if (offset <= begin || static_cast<double>(offset) > source.most_bytes()) return found;
    if (auto skipped = source.skip(begin); !skipped) return tl::unexpected(skipped.error());
    std::string bytes(std::min<std::uint64_t>(offset - begin, kMostExtensionBytes), '\0');
    if (auto read = source.read(bytes.data(), bytes.size()); !read) return tl::unexpected(read.error());
    found.used = begin + bytes.size();
    found.names = extension_names(bytes, header.swapped, found.notes);
    return found;
}

} // namespace

int nifti_version(std::string_view head) {
    nifti_set_debug_level(0); // or the library writes to standard error
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
    const VoxelLayout layout{size, type, header.swapped ? Encoding::kSwapped : Encoding::kBinary, scaling};
    RAMUS_TRY(extensions, extensions_of(header, source));
    auto volume = read_voxels(source, static_cast<std::uint64_t>(header.offset) - extensions.used, layout,
                              options.keeping(), job);
    if (!volume) return volume;
    if (!extensions.names.empty()) volume->label_names = std::move(extensions.names);
    volume->notes.insert(volume->notes.begin(), extensions.notes.begin(), extensions.notes.end());
    volume->to_patient = affine;
    volume->type = "NIfTI-" + std::to_string(header.version) + ", " + std::string(name_of(type));
    volume->unit_mm = unit_of(header);
    volume->window = window_of(header);
    if (header.sform <= 0 && header.qform <= 0)
        volume->notes.push_back(std::string(volume::kLeavesSidesOpen) + ": axes taken as right, anterior, superior");
    if (auto note = forms_differ(header, size, name)) volume->notes.push_back(std::move(*note));
    return volume;
}

} // namespace ramus::io
