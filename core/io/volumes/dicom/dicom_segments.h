// Reads DICOM segmentations (PS3.3, A.51): one file with a frame for each slice in which a segment has voxels.
#pragma once

#include "core/base/job.h"
#include "core/io/volumes/dicom/dicom_image.h"
#include "core/io/volumes/volume_file.h"

namespace ramus::io {

// Returns a mask whose labels are the numbers of the segments, with names and colours. Slices without a frame are
// empty. Fractions of one half and more are inside, with a note. Where segments overlap, a voxel belongs to all of
// them. Fails on frames without a position or not parallel, on positions between slices, on more slices than fit into
// memory, and like volume::OverlapTable.
[[nodiscard]] Result<volume::Volume> read_segments(const DicomImage& image, const ReadVolumeOptions& options,
                                                   const JobRange& job);

} // namespace ramus::io
