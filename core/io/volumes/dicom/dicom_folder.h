// The DICOM images in a folder, and which of them belong together.
#pragma once

#include "core/base/job.h"
#include "core/io/volumes/dicom/dicom_image.h"

#include <filesystem>
#include <string>
#include <vector>

namespace ramus::io {

// Whether the file's first bytes are those of DICOM.
[[nodiscard]] bool begins_as_dicom(const std::filesystem::path& file);

struct DicomFolder {
    std::vector<DicomImage> images; // by the names of their files
    std::vector<Error> unreadable;  // of files that begin as DICOM does
};

// Headers of all DICOM images that lie in the folder itself, read by all cores. Fails if it cannot be listed, and when
// cancelled.
[[nodiscard]] Result<DicomFolder> read_dicom_headers(const std::filesystem::path& folder, const JobRange& job);

// Images that make one volume: those of a series; files with several frames, and segmentations, each for itself.
struct DicomSeries {
    std::vector<DicomImage> images;
    std::size_t slices = 0; // of segmentations: places where a frame lies
};
// The largest first.
[[nodiscard]] std::vector<DicomSeries> series_of(std::vector<DicomImage> images);

} // namespace ramus::io
