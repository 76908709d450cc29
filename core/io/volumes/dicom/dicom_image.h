// What a DICOM file says of the images in it: one, or a frame after the other. Read from the
// elements that dicom_layout.h finds.
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

// Where a frame lies, in mm, LPS, as far as the file says.
struct DicomFrame {
    std::optional<glm::dvec3> position;                 // of the centre of its first pixel
    std::optional<std::array<glm::dvec3, 2>> direction; // of rows (along which columns count) and of columns
    std::optional<glm::dvec2> spacing;                  // from column to column, from row to row
    double between_slices = 0.0, thickness = 0.0;       // 0: not said
    volume::Scaling scaling;
    int segment = 0; // of segmentations
};

enum class SegmentKind { kNone, kBinary, kFractional, kLabels };

struct DicomImage {
    DicomBytes file;
    DicomLayout layout;
    std::string sop_class, sop_uid, series_uid, series_number, description, modality, photometric;
    bool localizer = false;
    int rows = 0, columns = 0, samples = 1;
    int bits_allocated = 0, bits_stored = 0, high_bit = 0;
    bool is_signed = false;
    std::vector<DicomFrame> frames;

    SegmentKind segments = SegmentKind::kNone;
    int most_fraction = 255; // of fractions: what stands for 1
    std::vector<volume::LabelName> segment_names;
};

// The image's series, its number and what it shows, for people: number 4, "Thorax 1.0", CT.
[[nodiscard]] std::string series_name(const DicomImage& image);

// Nothing: DICOM, but no image (a report, a plan, a list of files). Fails on damage, and on what no volume is made of:
// colours, frames without a place.
[[nodiscard]] Result<std::optional<DicomImage>> read_dicom_image(const DicomBytes& file);

} // namespace ramus::io
