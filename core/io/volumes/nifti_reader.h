// NIfTI-1 and NIfTI-2 in one file, compressed or not, of either byte order. What lies where follows the standard
// (nifti1.h, "3D IMAGE (VOLUME) ORIENTATION AND LOCATION IN SPACE"): the sform when its code is above 0, else the qform
// when its code is, else voxel sizes alone. Units other than metre and micron count as mm. Every number in the header
// is a claim: nothing is allocated before it has been held against the size of the file and the memory allowed.
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

// Integers of every width, single and double precision, one volume. Fails on all else with a word: complex numbers,
// colours, several volumes in time, values that are not finite, an affine that cannot be inverted.
[[nodiscard]] Result<volume::Volume> read_nifti(ByteSource& source, const ReadVolumeOptions& options, Job& job);

} // namespace ramus::io
