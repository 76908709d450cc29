// Parses the structure of a DICOM file (PS3.5, chapters 7 and A): the elements of its header, and the position of its
// pixels. Every length, also in nested sequences, is checked against the available bytes before memory is allocated.
// GDCM is used only to decode pixels (dicom_pixels.h), because damaged headers crash it.
#pragma once

#include "core/base/error.h"
#include "core/io/volumes/dicom/dicom_elements.h"
#include "core/io/volumes/stored_bytes.h"

#include <cstdint>
#include <string>
#include <string_view>

namespace ramus::io {

inline constexpr std::string_view kDicomBigEndian = "1.2.840.10008.1.2.2"; // explicit; PS3.5, A.3

struct DicomLayout {
    std::string transfer_syntax;                    // its UID
    std::uint64_t pixel_begin = 0, pixel_bytes = 0; // of the values, or of all fragments if compressed
    bool has_pixels = false, encapsulated = false;
    DicomSet elements; // those that readers of images need
};

// Whether a file begins as DICOM: with the magic number, or, as some old files, with a plausible first element.
[[nodiscard]] bool is_dicom(std::string_view head);

// Fails on truncated files, on lengths that exceed the enclosing element, on too deeply nested sequences, on data sets
// that are compressed as a whole, and on too many items.
[[nodiscard]] Result<DicomLayout> dicom_layout(const StoredBytes& file);

} // namespace ramus::io
