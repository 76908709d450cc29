// DICOM: a series of images (CT, MR, also with many frames in a file), which lie in a folder as a rule, or a
// segmentation. Compressed pixels go through GDCM. Images are sorted by where they lie, not by their names or numbers.
// Every length and size in a file is held against the bytes that are there and the memory allowed.
#pragma once

#include "core/io/volumes/dicom/dicom_layout.h"
#include "core/io/volumes/volume_file.h"

#include <filesystem>

namespace ramus::io {

// The series that the file belongs to, from all files of its folder that do, or the segmentation in it. From memory,
// or compressed by gzip, the file alone. Fails on images without a place, two at one place, missing slices, colours,
// and damage to it.
[[nodiscard]] Result<volume::Volume> read_dicom(ByteSource& source, const ReadVolumeOptions& options, Job& job);

// The series with the most images of all in the folder; a note names the others.
[[nodiscard]] Result<volume::Volume> read_dicom_folder(const std::filesystem::path& folder,
                                                       const ReadVolumeOptions& options, Job& job);

// Whether a file that begins as DICOM does lies in the folder itself.
[[nodiscard]] bool holds_dicom(const std::filesystem::path& folder);

} // namespace ramus::io
