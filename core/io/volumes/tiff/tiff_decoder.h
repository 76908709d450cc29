// Decodes compressed strips and tiles of TIFF with libtiff, in a separate process (core/base/own_process.h): a damaged
// stream can crash a decoder. The process gets the compressed bytes of a few strips or tiles, as a small TIFF file of
// their own, and nothing else.
#pragma once

#include "core/base/error.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace ramus::io {

// Consecutive strips of a page, or a row of its tiles, with their tags.
struct TiffSegments {
    std::uint64_t columns = 0, rows = 0;       // pixels of the result
    std::uint64_t width = 0, height = 0;       // pixels of a tile; of a strip: all columns, and its rows
    bool tiled = false, big_endian = false;    // big_endian: byte order of the numbers, and of `decoding`
    std::uint64_t bits = 8, sample_format = 1; // of a pixel
    std::uint64_t compression = 1, photometric = 1, fill_order = 1, predictor = 1;
    struct Tag {
        std::uint16_t tag = 0, type = 0;
        std::uint64_t count = 0;
        std::string bytes;
    };
    std::vector<Tag> decoding;        // further tags for the decoder
    std::vector<std::string> encoded; // each strip or tile

    [[nodiscard]] std::uint64_t row_bytes() const { return (columns * bits + 7) / 8; }
    [[nodiscard]] std::uint64_t decoded_bytes() const { return rows * row_bytes(); }
};

// Whether the libtiff of this machine can decode a compression, of those that this reader allows: without colours, and
// without reading other files.
[[nodiscard]] bool can_decode_tiff(std::uint64_t compression);
// "LZW", "JPEG"; "number 34712" if it is not known.
[[nodiscard]] std::string tiff_compression_name(std::uint64_t compression);

// The decoded rows of each, without padding at the right or below, in this machine's byte order. Fails if any of them
// cannot be decoded as a whole.
[[nodiscard]] Result<std::vector<std::string>> decode_tiff(const std::vector<TiffSegments>& all,
                                                           const std::string& name);

} // namespace ramus::io
