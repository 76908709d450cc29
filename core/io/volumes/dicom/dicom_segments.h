// DICOM segmentations (PS3.3, A.51): one file, a frame for each slice in which a segment has voxels.
#pragma once

#include "core/base/job.h"
#include "core/io/volumes/dicom/dicom_image.h"
#include "core/io/volumes/volume_file.h"

namespace ramus::io {

// A mask whose labels are the numbers of the segments, with their names and colours. Slices without a frame are empty.
// Of fractions those from one half on count, and a note says so. Where segments overlap, voxels belong to all of them.
// Fails on frames without a place or not parallel, on places between the slices, on more slices than fit into memory,
// and on more overlaps than core/volume/overlap_table.h allows.
[[nodiscard]] Result<volume::Volume> read_segments(const DicomImage& image, const ReadVolumeOptions& options,
                                                   const JobRange& job);

} // namespace ramus::io
