// Reads the voxels of a volume file into a Volume, and checks the sizes and affines that its header declares. Shared by
// the readers of NIfTI, NRRD and MetaImage; DICOM uses the checks.
#pragma once

#include "core/base/error.h"
#include "core/base/job.h"
#include "core/io/volumes/byte_source.h"
#include "core/volume/volume.h"
#include "core/volume/voxel_store.h"

#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace ramus::io {

enum class VoxelType { kUint8, kInt8, kUint16, kInt16, kUint32, kInt32, kUint64, kInt64, kFloat32, kFloat64 };
[[nodiscard]] std::string_view name_of(VoxelType type); // "uint8"
[[nodiscard]] std::size_t bytes_of(VoxelType type);

// Binary in this machine's byte order, binary in the other byte order, or text with blanks between numbers.
enum class Encoding { kBinary, kSwapped, kText };

class SegmentLayers;

// The layout of the voxels, from the header.
struct VoxelLayout {
    glm::ivec3 size{1};
    VoxelType type = VoxelType::kUint8;
    Encoding encoding = Encoding::kBinary;
    volume::Scaling scaling;
    // For a segmentation with several layers: merges the numbers of a voxel. Only for whole numbers. Null: one number
    // for each voxel.
    SegmentLayers* layers = nullptr;
};

// Converts the extents of the axes to a size. Fails, naming the axis counted from 1, on an extent below 1 or beyond 32
// bits, and on an extent above 1 after the third axis.
[[nodiscard]] Result<glm::ivec3> checked_size(const std::vector<std::int64_t>& extents, const std::string& name);

// Declared voxels: `file_bytes` that they take in the file, `most_bytes` that the file can provide, `memory_bytes` that
// they may take. In double precision, which does not overflow.
struct DeclaredVoxels {
    glm::ivec3 size;
    double file_bytes, most_bytes, memory_bytes;
};
// Fails if the file cannot hold the declared voxels, or a mask of them (one bit each) takes too much memory.
[[nodiscard]] Result<void> check_declared_size(const DeclaredVoxels& declared, const std::string& name);

// Skips `offset` bytes and reads the voxels. The result has size, values and range. Fails like check_declared_size(),
// before memory is allocated, and on invalid or missing numbers.
[[nodiscard]] Result<volume::Volume> read_voxels(ByteSource& source, std::uint64_t offset, const VoxelLayout& layout,
                                                 const volume::Keeping& keeping, Job& job);

// Fails if an affine to mm is not invertible, or puts voxels where no patient can be (10 km away). `form`: the file's
// name for it, such as "sform"; `remedy`: the hint of the error.
[[nodiscard]] Result<void> check_affine(const glm::dmat4& affine, const glm::ivec3& size, const std::string& form,
                                        const std::string& remedy, const std::string& name);

// Converts an affine from LPS to RAS: negates x and y.
[[nodiscard]] glm::dmat4 lps_to_ras(glm::dmat4 affine);

// The axis across a single planar image with axes x and y: 1 mm along its normal.
[[nodiscard]] glm::dvec3 slice_axis(const glm::dvec3& x, const glm::dvec3& y);

} // namespace ramus::io
