// Reads NIfTI-1 and NIfTI-2 in one file, compressed or not, of either byte order. The position of the voxels follows
// the standard (nifti1.h, "3D IMAGE (VOLUME) ORIENTATION AND LOCATION IN SPACE"): the sform if its code is above 0,
// else the qform if its code is above 0, else voxel sizes alone. Units other than metre and micron count as mm.
// Declared sizes are checked against the size of the file and the allowed memory before anything is allocated.
#pragma once

#include "core/base/error.h"
#include "core/base/job.h"
#include "core/io/volumes/byte_source.h"
#include "core/io/volumes/volume_file.h"

#include <string_view>

namespace ramus::io {

// 1 or 2; 0: an ANALYZE 7.5 header, or half of a pair of files; -1: none of these.
[[nodiscard]] int nifti_version(std::string_view head);
[[nodiscard]] inline bool is_nifti(std::string_view head) { return nifti_version(head) >= 0; }

// Reads one volume of integers or floating-point numbers of any size. Fails on complex numbers, colours, several
// volumes in time, infinite values, and an affine that cannot be inverted.
[[nodiscard]] Result<volume::Volume> read_nifti(ByteSource& source, const ReadVolumeOptions& options, Job& job);

} // namespace ramus::io
