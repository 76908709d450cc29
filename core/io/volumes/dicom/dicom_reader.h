// Reads DICOM: a series of images (CT, MR, also with many frames in a file), usually all files of a folder, or a
// segmentation. Images are sorted by their position, not by name or number. Lengths and sizes are checked against the
// available bytes and the allowed memory.
#pragma once

#include "core/io/volumes/dicom/dicom_layout.h"
#include "core/io/volumes/volume_file.h"

#include <filesystem>

namespace ramus::io {

// Reads the series of the file, from all files of its folder that belong to it, or the segmentation in it. A file in
// memory or compressed by gzip is read alone. Fails on images without a position, two images at one position, missing
// slices, colours, and damaged images of the series.
[[nodiscard]] Result<volume::Volume> read_dicom(ByteSource& source, const ReadVolumeOptions& options, Job& job);

// Reads the series with the most slices in the folder; a note names the others.
[[nodiscard]] Result<volume::Volume> read_dicom_folder(const std::filesystem::path& folder,
                                                       const ReadVolumeOptions& options, Job& job);

// Whether a DICOM file is directly in the folder.
[[nodiscard]] bool holds_dicom(const std::filesystem::path& folder);

} // namespace ramus::io
