// DICOM segmentations (PS3.3, A.51): one file, a frame for each slice in which a segment has voxels.
#pragma once

#include "core/base/job.h"
#include "core/io/volumes/dicom/dicom_image.h"
#include "core/io/volumes/volume_file.h"

namespace ramus::io {

// A mask whose labels are the numbers of the segments, with their names. Slices without a frame are empty. Of fractions
// those from one half on count; where segments overlap, the one with the highest number; notes say both. Fails on
// frames without a place or not parallel, on places between the slices, and on more slices than fit into memory.
[[nodiscard]] Result<volume::Volume> read_segments(const DicomImage& image, const ReadVolumeOptions& options,
                                                   const JobRange& job);

} // namespace ramus::io
