#include "core/io/volumes/tiff/tiff_decoder.h"

#include "core/base/own_process.h"
#include "core/io/binary_numbers.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <memory>
#include <tiffio.h>

namespace ramus::io {

namespace {

struct TiffCompression {
    std::uint64_t number;
    const char* name;
};
// Those that can hold pixels of one sample.
constexpr std::array<TiffCompression, 11> kTiffCompressions = {{{2, "CCITT modified Huffman"},
                                                                {3, "CCITT group 3"},
                                                                {4, "CCITT group 4"},
                                                                {5, "LZW"},
                                                                {7, "JPEG"},
                                                                {8, "Deflate"},
                                                                {32773, "PackBits"},
                                                                {32946, "Deflate"},
                                                                {34887, "LERC"},
                                                                {34925, "LZMA"},
                                                                {50000, "Zstandard"}}};

// Writes whole numbers in the byte order of the file.
void put_number(std::string& text, std::uint64_t number, std::size_t bytes, bool big_endian) {
    for (std::size_t n = 0; n < bytes; ++n) {
        const std::size_t at = big_endian ? bytes - 1 - n : n;
        text += static_cast<char>(number >> (8 * at) & 0xFF);
    }
}

constexpr std::uint16_t kTagShort = 3, kTagLong8 = 16; // types of tags

TiffSegments::Tag tag_of(std::uint16_t tag, std::uint16_t type, const std::vector<std::uint64_t>& values,
                         bool big_endian) {
    TiffSegments::Tag entry{tag, type, values.size(), {}};
    for (const std::uint64_t value : values) put_number(entry.bytes, value, type == kTagShort ? 2 : 8, big_endian);
    return entry;
}

// A BigTIFF file of one page with these segments.
std::string small_tiff(const TiffSegments& from) {
    using Tag = TiffSegments::Tag;
    const auto numbers = [&](std::uint16_t tag, std::uint16_t type, const std::vector<std::uint64_t>& values) {
        return tag_of(tag, type, values, from.big_endian);
    };
    std::string file = from.big_endian ? "MM" : "II";
    put_number(file, 43, 2, from.big_endian);
    put_number(file, 8, 2, from.big_endian);
    put_number(file, 0, 2, from.big_endian);
    put_number(file, 0, 8, from.big_endian); // set below: the position of the tags
    std::vector<std::uint64_t> offsets, counts;
    for (const std::string& each : from.encoded) {
        offsets.push_back(file.size());
        counts.push_back(each.size());
        file += each;
    }
    std::vector<Tag> tags{numbers(256, kTagLong8, {from.columns}),
                          numbers(257, kTagLong8, {from.rows}),
                          numbers(258, kTagShort, {from.bits}),
                          numbers(259, kTagShort, {from.compression}),
                          numbers(262, kTagShort, {from.photometric}),
                          numbers(266, kTagShort, {from.fill_order}),
                          numbers(277, kTagShort, {1}),
                          numbers(284, kTagShort, {1}),
                          numbers(317, kTagShort, {from.predictor}),
                          numbers(339, kTagShort, {from.sample_format}),
                          numbers(from.tiled ? 324 : 273, kTagLong8, offsets),
                          numbers(from.tiled ? 325 : 279, kTagLong8, counts)};
    if (from.tiled) {
        tags.push_back(numbers(322, kTagLong8, {from.width}));
        tags.push_back(numbers(323, kTagLong8, {from.height}));
    } else {
        tags.push_back(numbers(278, kTagLong8, {from.height}));
    }
    tags.insert(tags.end(), from.decoding.begin(), from.decoding.end());
    std::ranges::sort(tags, {}, &Tag::tag);
    constexpr std::size_t kWord = 8;
    for (Tag& tag : tags) {
        if (tag.bytes.size() > kWord) {
            const std::uint64_t position = file.size();
            file += tag.bytes;
            tag.bytes.clear();
            put_number(tag.bytes, position, kWord, from.big_endian);
        }
        tag.bytes.resize(kWord, '\0');
    }
    std::string position;
    put_number(position, file.size(), kWord, from.big_endian);
    file.replace(8, kWord, position);
    put_number(file, tags.size(), kWord, from.big_endian);
    for (const Tag& tag : tags) {
        put_number(file, tag.tag, 2, from.big_endian);
        put_number(file, tag.type, 2, from.big_endian);
        put_number(file, tag.count, kWord, from.big_endian);
        file += tag.bytes;
    }
    put_number(file, 0, kWord, from.big_endian);
    return file;
}

// libtiff's view of bytes in memory.
struct MemoryFile {
    std::string_view bytes;
    std::uint64_t at = 0;
};

tmsize_t read_memory(thandle_t handle, void* into, tmsize_t count) {
    auto& file = *static_cast<MemoryFile*>(handle);
    const std::uint64_t left = file.at < file.bytes.size() ? file.bytes.size() - file.at : 0;
    const std::uint64_t got = std::min(left, static_cast<std::uint64_t>(count));
    if (got > 0) std::memcpy(into, file.bytes.data() + file.at, got);
    file.at += got;
    return static_cast<tmsize_t>(got);
}
tmsize_t write_memory(thandle_t /*handle*/, void* /*from*/, tmsize_t /*count*/) { return 0; }
toff_t seek_memory(thandle_t handle, toff_t offset, int from) {
    auto& file = *static_cast<MemoryFile*>(handle);
    file.at = offset + (from == SEEK_CUR ? file.at : from == SEEK_END ? file.bytes.size() : 0);
    return file.at;
}
int close_memory(thandle_t /*handle*/) { return 0; }
toff_t size_of_memory(thandle_t handle) { return static_cast<MemoryFile*>(handle)->bytes.size(); }

// Appends the pixels of the only page. False: not all of them can be decoded.
bool append_pixels(TIFF* tiff, std::string& pixels) {
    std::uint32_t columns = 0, rows = 0;
    std::uint16_t bits = 1;
    if (TIFFGetField(tiff, TIFFTAG_IMAGEWIDTH, &columns) == 0 || TIFFGetField(tiff, TIFFTAG_IMAGELENGTH, &rows) == 0)
        return false;
    TIFFGetFieldDefaulted(tiff, TIFFTAG_BITSPERSAMPLE, &bits);
    const std::uint64_t row_bytes = (std::uint64_t{columns} * bits + 7) / 8;
    const std::size_t begin = pixels.size();
    pixels.resize(begin + row_bytes * rows);
    char* into = pixels.data() + begin;
    if (TIFFIsTiled(tiff) == 0) {
        std::uint32_t strip_rows = rows;
        TIFFGetFieldDefaulted(tiff, TIFFTAG_ROWSPERSTRIP, &strip_rows);
        std::uint32_t strip = 0;
        for (std::uint32_t row = 0; row < rows; row += std::min(strip_rows, rows - row), ++strip) {
            const auto bytes = static_cast<tmsize_t>(std::min(strip_rows, rows - row) * row_bytes);
            if (TIFFReadEncodedStrip(tiff, strip, into + row * row_bytes, bytes) != bytes) return false;
        }
        return true;
    }
    std::uint32_t width = 0;
    TIFFGetField(tiff, TIFFTAG_TILEWIDTH, &width);
    const auto tile_bytes = TIFFTileSize(tiff), tile_row = TIFFTileRowSize(tiff);
    if (tile_bytes <= 0 || tile_row <= 0 || width == 0) return false;
    std::string tile(static_cast<std::size_t>(tile_bytes), '\0');
    for (std::uint32_t column = 0, n = 0; column < columns; column += std::min(width, columns - column), ++n) {
        if (TIFFReadEncodedTile(tiff, n, tile.data(), tile_bytes) != tile_bytes) return false;
        const std::uint64_t first = std::uint64_t{column} * bits / 8;
        const std::uint64_t part = std::min(static_cast<std::uint64_t>(tile_row), row_bytes - first);
        for (std::uint32_t row = 0; row < rows; ++row)
            std::memcpy(into + row * row_bytes + first, tile.data() + row * static_cast<std::size_t>(tile_row), part);
    }
    return true;
}

// `input`: small files, each after its length. The answer: their pixels. Empty: some cannot be decoded.
std::string decode_small_tiffs(std::string_view input) {
    TIFFSetErrorHandler(nullptr);
    TIFFSetWarningHandler(nullptr);
    std::string pixels;
    while (const auto length = take_number<std::uint64_t>(input)) {
        MemoryFile file{input.substr(0, *length)};
        input.remove_prefix(*length);
        const std::unique_ptr<TIFF, decltype(&TIFFClose)> tiff(TIFFClientOpen("pages", "rm", &file, read_memory,
                                                                              write_memory, seek_memory, close_memory,
                                                                              size_of_memory, nullptr, nullptr),
                                                               &TIFFClose);
        if (!tiff || !append_pixels(tiff.get(), pixels)) return {};
    }
    return pixels;
}

} // namespace

bool can_decode_tiff(std::uint64_t compression) {
    const auto* known = std::ranges::find(kTiffCompressions, compression, &TiffCompression::number);
    return known != kTiffCompressions.end() && TIFFIsCODECConfigured(static_cast<std::uint16_t>(compression)) != 0;
}

std::string tiff_compression_name(std::uint64_t compression) {
    const auto* known = std::ranges::find(kTiffCompressions, compression, &TiffCompression::number);
    return known == kTiffCompressions.end() ? "number " + std::to_string(compression) : known->name;
}

Result<std::vector<std::string>> decode_tiff(const std::vector<TiffSegments>& all, const std::string& name) {
    std::string input;
    std::uint64_t decoded = 0, largest = 0;
    for (const TiffSegments& each : all) {
        const std::string file = small_tiff(each);
        append_number<std::uint64_t>(input, file.size());
        input += file;
        decoded += each.decoded_bytes();
        largest = std::max(largest, each.width * each.height * each.bits / 8);
    }
    ProcessLimits limits;
    limits.memory += 4 * (decoded + largest) + input.size();
    limits.answer = decoded + 1;
    auto pixels = run_in_own_process(decode_small_tiffs, input, limits);
    if (!pixels || pixels->size() != decoded)
        return fail("its compressed pixels (" + tiff_compression_name(all.front().compression) +
                        ") cannot be decoded: they are damaged, or other than its tags say",
                    name, "copy or write it again, or write it without compression");
    std::vector<std::string> parts;
    std::uint64_t at = 0;
    for (const TiffSegments& each : all) {
        parts.push_back(pixels->substr(at, each.decoded_bytes()));
        at += each.decoded_bytes();
    }
    return parts;
}

} // namespace ramus::io
