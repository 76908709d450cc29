// Reads the headers of all DICOM images in a folder, and groups them into series.
#pragma once

#include "core/base/job.h"
#include "core/io/volumes/dicom/dicom_image.h"

#include <filesystem>
#include <string>
#include <vector>

namespace ramus::io {

// Whether the file's first bytes identify it as DICOM.
[[nodiscard]] bool begins_as_dicom(const std::filesystem::path& file);

struct DicomFolder {
    std::vector<DicomImage> images; // by the names of their files
    std::vector<Error> unreadable;  // of damaged DICOM files
};

// Reads the headers of all DICOM images directly in the folder, in parallel. Fails if the folder cannot be listed, and
// when cancelled.
[[nodiscard]] Result<DicomFolder> read_dicom_headers(const std::filesystem::path& folder, const JobRange& job);

// Images of one volume: those of a series. A file with several frames and a segmentation are volumes of their own.
struct DicomSeries {
    std::vector<DicomImage> images;
    std::size_t slices = 0; // number of frames; of a segmentation: of different positions
};
// Sorted by the number of slices, the largest first; among equals images before segmentations.
[[nodiscard]] std::vector<DicomSeries> series_of(std::vector<DicomImage> images);

} // namespace ramus::io
