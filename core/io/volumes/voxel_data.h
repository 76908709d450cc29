// What readers of volumes share: the types that numbers have in files, a loop that reads them into a VoxelStore, and
// the checks that every claim of a header goes through before memory is taken for it.
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

enum class Encoding { kBinary, kSwapped, kText }; // binary in this machine's byte order, in the other; blanks between

class SegmentLayers;

// What a header says of its voxels.
struct VoxelLayout {
    glm::ivec3 size{1};
    VoxelType type = VoxelType::kUint8;
    Encoding encoding = Encoding::kBinary;
    volume::Scaling scaling;
    // Of a segmentation whose voxels have a number in each of several layers: what these mean. Not of fractions.
    SegmentLayers* layers = nullptr;
};

// The extents of the axes, of which those beyond the third must be 1. Fails naming the axis, counted from 1.
[[nodiscard]] Result<glm::ivec3> checked_size(const std::vector<std::int64_t>& extents, const std::string& name);

// Whether voxels that take so many bytes in the file can come from those that are there, and may be kept in memory; in
// numbers that do not overflow.
struct DeclaredVoxels {
    glm::ivec3 size;
    double file_bytes, most_bytes, memory_bytes;
};
[[nodiscard]] Result<void> check_declared_size(const DeclaredVoxels& declared, const std::string& name);

// The voxels of `layout`, `offset` bytes ahead of where the source is, with size, values and range. What they claim is
// checked first.
[[nodiscard]] Result<volume::Volume> read_voxels(ByteSource& source, std::uint64_t offset, const VoxelLayout& layout,
                                                 double memory_bytes, Job& job);

// Whether an affine puts the voxels where a patient can be, in mm, and can be turned round. `form`: what the file calls
// it, "sform"; `remedy`: what to do about it.
[[nodiscard]] Result<void> check_affine(const glm::dmat4& affine, const glm::ivec3& size, const std::string& form,
                                        const std::string& remedy, const std::string& name);

// x and y the other way: from left, posterior, superior to right, anterior, superior.
[[nodiscard]] glm::dmat4 lps_to_ras(glm::dmat4 affine);

// An axis that images in a plane lack: 1 mm along their normal.
[[nodiscard]] glm::dvec3 slice_axis(const glm::dvec3& x, const glm::dvec3& y);

} // namespace ramus::io
