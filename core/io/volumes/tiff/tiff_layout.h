// Parses the structure of a TIFF file (TIFF 6.0, Adobe 1992; BigTIFF, Aware Systems 2007): its pages, and where their
// pixels are. Every position and count is checked against the size of the file before memory is allocated, and the
// chain of pages must not lead back. libtiff only decodes pixels (tiff_decoder.h), in a process of its own: it needs no
// other part of the file there.
#pragma once

#include "core/base/error.h"
#include "core/io/volumes/stored_bytes.h"

#include <array>
#include <cstdint>
#include <istream>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ramus::io {

// The values of a tag: `count` values of `type` at `position` of the file.
struct TiffField {
    std::uint16_t type = 0;
    std::uint64_t count = 0, position = 0;
};

// The tags of one image that this reader uses, with TIFF's defaults. Nothing in it has been checked yet.
struct TiffPage {
    std::uint64_t width = 0, height = 0;
    std::uint64_t bits = 1, samples = 1, compression = 1, photometric = 1, fill_order = 1, predictor = 1;
    std::uint64_t sample_format = 1;                  // 1 unsigned, 2 signed, 3 floating point
    std::uint64_t rows_per_strip = 0xFFFFFFFF;        // of strips
    std::uint64_t tile_width = 0, tile_height = 0;    // 0: strips
    std::uint64_t kind = 0;                           // NewSubfileType: 1 a smaller copy of another page, 4 a mask
    std::uint64_t orientation = 1;                    // 1: the first row is at the top
    std::optional<std::array<double, 2>> resolution;  // pixels in a unit, along x and y
    std::uint64_t resolution_unit = 2;                // 1 none, 2 inch, 3 cm
    std::optional<TiffField> offsets, counts;         // of strips or tiles, in bytes
    std::array<std::optional<TiffField>, 4> decoding; // kTiffDecodingTags

    [[nodiscard]] bool tiled() const { return tile_width > 0; }
    [[nodiscard]] bool same_pixels(const TiffPage& other) const {
        return width == other.width && height == other.height && bits == other.bits &&
               sample_format == other.sample_format;
    }
};

// Tags that only the decoders of some compressions need: T4Options, T6Options, JPEGTables, LercParameters.
inline constexpr std::array<std::uint16_t, 4> kTiffDecodingTags = {292, 293, 347, 50674};

struct TiffLayout {
    bool big_endian = false, big = false; // byte order; BigTIFF
    std::uint64_t file_bytes = 0;
    std::vector<TiffPage> pages; // in the file's order, without smaller copies and masks of pages
    std::string description;     // ImageDescription of the first page
    std::size_t left_out = 0;    // smaller copies and masks
};

// Whether a file begins as TIFF or BigTIFF.
[[nodiscard]] bool is_tiff(std::string_view head);

// Fails on truncated files, on values beyond the end of the file, on a chain of pages that leads back, and on more than
// 262,144 pages.
[[nodiscard]] Result<TiffLayout> tiff_layout(const StoredBytes& file);

// The values of a field of whole numbers. Fails on another type.
[[nodiscard]] Result<std::vector<std::uint64_t>> tiff_numbers(std::istream& stream, const TiffLayout& layout,
                                                              const TiffField& field, const std::string& name);
// The bytes of a field, as they are in the file.
[[nodiscard]] Result<std::string> tiff_bytes(std::istream& stream, const TiffField& field, const std::string& name);
[[nodiscard]] std::uint64_t bytes_of(const TiffField& field);

// `bytes` bytes at `position`, which the caller has checked against the size of the file.
[[nodiscard]] Result<std::string> bytes_at(std::istream& stream, std::uint64_t position, std::uint64_t bytes,
                                           const std::string& name);

} // namespace ramus::io
