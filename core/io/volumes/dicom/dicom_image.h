// Reads the description of the image in a DICOM file, which may have several frames, from the elements that
// dicom_layout.h finds.
#pragma once

#include "core/io/volumes/dicom/dicom_layout.h"
#include "core/volume/volume.h"
#include "core/volume/voxel_store.h"

#include <array>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

namespace ramus::io {

// The position of a frame in mm, LPS, as far as the file states it.
struct DicomFrame {
    std::optional<glm::dvec3> position;                 // of the centre of its first pixel
    std::optional<std::array<glm::dvec3, 2>> direction; // along a row, and along a column
    std::optional<glm::dvec2> spacing;                  // between columns, and between rows
    double between_slices = 0.0, thickness = 0.0;       // 0: not stated
    volume::Scaling scaling;
    bool scaled = false;    // the file states a scaling
    std::string value_type; // Rescale Type; empty: not stated
    std::optional<volume::DisplayWindow> window;
    int segment = 0; // its number, for segmentations
};

enum class SegmentKind { kNone, kBinary, kFractional, kLabels };

struct DicomImage {
    StoredBytes file;
    DicomLayout layout;
    std::string sop_class, series_uid, series_number, description, modality, photometric;
    bool localizer = false;
    bool implies_hounsfield = false; // its scaled values are in HU unless they state another type
    int rows = 0, columns = 0, samples = 1;
    int bits_allocated = 0, bits_stored = 0, high_bit = 0;
    bool is_signed = false;
    std::vector<DicomFrame> frames;

    SegmentKind segments = SegmentKind::kNone;
    int most_fraction = 255; // for fractions: the pixel value that means 1
    std::vector<volume::LabelName> segment_names;
};

// The series of the image for people: number 4, "Thorax 1.0", CT.
[[nodiscard]] std::string series_name(const DicomImage& image);

// The unit of a frame's values: "HU". Empty: the file leaves it open.
[[nodiscard]] std::string value_unit(const DicomImage& image, const DicomFrame& frame);

// None: a DICOM file without an image (a report, a plan, a list of files). Fails on damaged files, and on images that
// make no volume: colours, frames without a position.
[[nodiscard]] Result<std::optional<DicomImage>> read_dicom_image(const StoredBytes& file);

} // namespace ramus::io
