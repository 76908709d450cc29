// Where what lies in a DICOM file (PS3.5, chapters 7 and A): the elements of its header, and the pixels behind it.
// Every length in the file is held against the bytes that are there, sequences in sequences included, before anybody
// allocates by it. GDCM, which decodes pixels (dicom_pixels.h), does not read headers: damaged ones end the program
// there.
#pragma once

#include "core/base/error.h"
#include "core/io/volumes/dicom/dicom_elements.h"

#include <cstdint>
#include <filesystem>
#include <istream>
#include <memory>
#include <string>
#include <string_view>

namespace ramus::io {

// The bytes of a DICOM file: in a file, or in memory.
struct DicomBytes {
    std::filesystem::path path;               // empty: in memory
    std::shared_ptr<const std::string> bytes; // null: in the file
    std::string name;                         // for errors

    [[nodiscard]] Result<std::unique_ptr<std::istream>> open() const;
    [[nodiscard]] Result<std::uint64_t> size() const;
};

inline constexpr std::string_view kDicomBigEndian = "1.2.840.10008.1.2.2"; // explicit; PS3.5, A.3

struct DicomLayout {
    std::string transfer_syntax; // its UID
    std::uint64_t header_bytes = 0;
    std::uint64_t pixel_begin = 0, pixel_bytes = 0; // of the values; of compressed ones, all fragments
    bool has_pixels = false, encapsulated = false;
    DicomSet elements; // those that readers of images want
};

// Whether a file begins as DICOM does: with its mark, or, as some old ones, with a first element right away.
[[nodiscard]] bool is_dicom(std::string_view head);

// Fails on files that end early, lengths that lead out of what they are part of, sequences deeper than anybody needs,
// data sets that are compressed as a whole, and more items than an image has.
[[nodiscard]] Result<DicomLayout> dicom_layout(const DicomBytes& file);

} // namespace ramus::io
